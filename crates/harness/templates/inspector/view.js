// Panes that show pictures of one size, all at the same zoom and place.
const makeView = (stage, { source, marked, onHover, onMark, onChange }) => {
  const view = { zoom: 1, center: [0, 0], size: [1, 1], panes: [] };
  const pointers = new Map();
  let travelled = 0;

  const place = (pane) => [pane.canvas.clientWidth, pane.canvas.clientHeight];
  const fitting = () => {
    const [wide, high] = view.panes.length ? place(view.panes[0]) : [1, 1];
    return Math.max(Math.min(wide / view.size[0], high / view.size[1]), 0.01);
  };
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
  view.fit = () => {
    view.center = view.size.map((side) => side / 2);
    view.zoom = fitting();
    view.fitted = true;
    view.draw();
  };
  // Zooms so that the image point `about` stays where it is on the screen.
  view.zoomTo = (zoom, about = view.center) => {
    const next = clamp(zoom, Math.min(fitting(), 1) / 2, 96);
    view.center = view.center.map((middle, axis) => about[axis] + ((middle - about[axis]) * view.zoom) / next);
    view.zoom = next;
    view.moved();
  };
  view.lookAt = (point, zoom = view.zoom) => {
    view.center = [...point];
    view.zoom = zoom;
    view.moved();
  };
  view.moved = () => {
    view.fitted = false;
    view.center = view.center.map((middle, axis) => clamp(middle, 0, view.size[axis]));
    view.draw();
    onChange();
  };

  // The image point under a pointer.
  const under = (canvas, event) => {
    const box = canvas.getBoundingClientRect();
    const from = [event.clientX - box.left - box.width / 2, event.clientY - box.top - box.height / 2];
    return from.map((part, axis) => view.center[axis] + part / view.zoom);
  };
  const pixelAt = (point) => {
    const pixel = point.map(Math.floor);
    return pixel.every((part, axis) => part >= 0 && part < view.size[axis]) ? pixel : null;
  };

  const frame = (context, [x, y], zoom, line) => {
    const grow = Math.max(3 - zoom, 0) / 2;
    const [left, top, side] = [x * zoom - grow, y * zoom - grow, zoom + 2 * grow];
    for (const [color, width] of [["#000", 3 * line], ["#fff", line]]) {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.strokeRect(left - line, top - line, side + 2 * line, side + 2 * line);
    }
  };
  view.draw = () => {
    for (const pane of view.panes) {
      const { canvas, kind } = pane;
      const ratio = window.devicePixelRatio || 1;
      const [wide, high] = place(pane).map((side) => Math.max(Math.round(side * ratio), 1));
      if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, { width: wide, height: high });
      const context = canvas.getContext("2d");
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.clearRect(0, 0, wide, high);
      const zoom = view.zoom * ratio;
      const corner = view.center.map((middle, axis) => Math.round([wide, high][axis] / 2 - middle * zoom));
      context.setTransform(1, 0, 0, 1, ...corner);
      const picture = source(kind);
      // Pixels are squares, unless there are more of them than the screen has.
      context.imageSmoothingEnabled = zoom < 1;
      context.imageSmoothingQuality = "high";
      if (picture) context.drawImage(picture, 0, 0, view.size[0] * zoom, view.size[1] * zoom);
      const pixel = marked();
      if (pixel) frame(context, pixel, zoom, Math.max(ratio, 1));
    }
  };

  const spread = () => {
    const [a, b] = [...pointers.values()];
    return b && {
      far: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY),
      middle: { clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 },
    };
  };
  const listen = (canvas) => {
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, event);
      if (pointers.size === 1) travelled = 0;
      if (event.pointerType === "mouse") event.preventDefault();
      stage.focus({ preventScroll: true });
    });
    canvas.addEventListener("pointermove", (event) => {
      const last = pointers.get(event.pointerId);
      if (!last) {
        onHover(pixelAt(under(canvas, event)));
        return;
      }
      const before = spread();
      pointers.set(event.pointerId, event);
      const by = [event.clientX - last.clientX, event.clientY - last.clientY];
      travelled += Math.hypot(...by);
      if (pointers.size === 1 && travelled > 3) {
        view.center = view.center.map((middle, axis) => middle - by[axis] / view.zoom);
        view.moved();
      } else if (before && before.far > 0) {
        const now = spread();
        const about = under(canvas, before.middle);
        view.zoomTo((view.zoom * now.far) / before.far, about);
        const drift = [now.middle.clientX - before.middle.clientX, now.middle.clientY - before.middle.clientY];
        view.center = view.center.map((middle, axis) => middle - drift[axis] / view.zoom);
        view.moved();
      }
    });
    const end = (event) => {
      const single = pointers.size === 1;
      if (!pointers.delete(event.pointerId) || !single) {
        travelled = Infinity;
        return;
      }
      const pixel = pixelAt(under(canvas, event));
      if (event.type === "pointerup" && travelled <= 3 && pixel) onMark(pixel);
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("pointerleave", () => onHover(null));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 20 : event.deltaMode === 2 ? 400 : 1;
      view.zoomTo(view.zoom * 2 ** clamp((-event.deltaY * lines) / 240, -1, 1), under(canvas, event));
    }, { passive: false });
  };

  // Shows these kinds of pictures, each with its name.
  view.show = (kinds) => {
    pointers.clear();
    view.panes = kinds.map(({ kind, name }) => {
      const pane = document.createElement("figure");
      const canvas = document.createElement("canvas");
      const caption = document.createElement("figcaption");
      canvas.setAttribute("role", "img");
      canvas.setAttribute("aria-label", name);
      caption.textContent = kinds.length > 1 ? name : "";
      pane.append(canvas, caption);
      listen(canvas);
      return { kind, canvas, pane };
    });
    stage.replaceChildren(...view.panes.map(({ pane }) => pane));
    // So many columns that the panes become as large as they can.
    const [wide, high] = [stage.clientWidth || 1, stage.clientHeight || 1];
    const large = (columns) => {
      const rows = Math.ceil(kinds.length / columns);
      return Math.min(wide / columns / view.size[0], high / rows / view.size[1]);
    };
    const columns = kinds.map((_, place) => place + 1).sort((a, b) => large(b) - large(a))[0] || 1;
    stage.style.setProperty("--columns", columns);
    stage.style.setProperty("--rows", Math.ceil(kinds.length / columns));
    if (view.fitted) view.fit();
    else view.draw();
  };

  new ResizeObserver(() => {
    if (!stage.clientWidth) return;
    if (view.fitted) view.fit();
    else view.draw();
  }).observe(stage);
  return view;
};
