// The inspector: a picture of the page fills the window, with the values of its pixels.
const inspector = (() => {
  const { number, withUnit, cell, swatch } = loupe;
  const KINDS = [
    ["reference", "reference"],
    ["technique", "technique"],
    ["angle", "angular error"],
    ["coverage", "coverage"],
    ["color", "colour error"],
    ["flip", "FLIP"],
    ["difference", "difference"],
    ["levels", "virtual triangles"],
  ].map(([kind, name]) => ({ kind, name }));
  // Painted from values alone: no picture of the page shows them.
  const VALUES_ONLY = ["color", "flip", "difference"];
  // Decades by which a scale's top can be lowered or raised.
  const SCALES = { angle: [-4, 0.3], color: [-3, 0.7], flip: [-3, 0], difference: [-3, 0.7] };
  const CLOSE_UP = 11;

  const entries = [];
  for (const box of document.querySelectorAll(".pictures[data-layers]")) {
    const { scene, technique, layers: path, truth } = box.dataset;
    if (entries.some((entry) => entry.layers === path)) continue;
    const images = {};
    for (const image of box.querySelectorAll("img[data-picture]")) images[image.dataset.picture] = image;
    const size = ["width", "height"].map((side) => Number(images.reference.getAttribute(side)));
    entries.push({ scene, technique, layers: path, truth, size, images });
  }
  const group = (entry) => `${entry.scene} ${entry.size.join("×")}`;
  const groups = [...new Set(entries.map(group))];

  const dialog = document.createElement("dialog");
  dialog.className = "inspector";
  dialog.setAttribute("aria-label", "Inspector");
  dialog.innerHTML = `
<header>
  <span class="which"><select name="scene" aria-label="Scene"></select></span>
  <span class="which"><button type="button" data-do="back" title="previous technique (←)" aria-label="Previous technique">←</button><select name="technique" aria-label="Technique"></select><button type="button" data-do="next" title="next technique (→)" aria-label="Next technique">→</button></span>
  <span class="kinds" role="group" aria-label="Picture"></span>
  <span class="zooms"><button type="button" data-do="out" title="smaller (−)" aria-label="Smaller">−</button><output class="zoom"></output><button type="button" data-do="in" title="larger (+)" aria-label="Larger">+</button><button type="button" data-do="fit" title="whole picture (0)">fit</button><button type="button" data-do="all" title="all pictures side by side (A)" aria-pressed="false">all at once</button></span>
  <button type="button" class="close" data-do="close" title="close (Esc)" aria-label="Close">✕</button>
</header>
<div class="stage" tabindex="0" aria-label="Picture: drag to move, wheel or + and − to zoom, click to mark a pixel"></div>
<aside>
  <p class="message" role="status" hidden></p>
  <div class="valued">
    <p class="worst"><button type="button" data-do="worst" title="worst pixel (W)"></button></p>
    <h4 class="pixel"></h4>
    <div class="loupe" aria-hidden="true"></div>
    <div class="scroll"><table class="values"><thead><tr><th></th><th scope="col">reference</th><th scope="col" class="by"></th></tr></thead><tbody></tbody></table></div>
    <div class="sliders">
      <label class="exposure">exposure <output></output><input type="range" name="exposure" min="-6" max="6" step="0.25" value="0"></label>
      <label class="top"><span></span> <output></output><input type="range" name="top" step="0.05" value="0"></label>
      <div class="legend"></div>
      <button type="button" data-do="reset">reset</button>
    </div>
    <h4 class="spread"></h4>
    <svg class="histogram" viewBox="0 0 240 78" role="img" aria-label="Histogram of the error"></svg>
    <p class="percentiles"></p>
    <p class="covered small"></p>
    <p class="steps small"></p>
  </div>
  <p class="small keys"><kbd>1</kbd> <kbd>2</kbd> <kbd>3</kbd> … pictures, <kbd>←</kbd> <kbd>→</kbd> technique, <kbd>↑</kbd> <kbd>↓</kbd> scene, <kbd>W</kbd> worst pixel, <kbd>+</kbd> <kbd>−</kbd> <kbd>0</kbd> zoom, <kbd>Shift</kbd> with arrows: next pixel, <kbd>A</kbd> all at once, <kbd>Esc</kbd> close. Drag moves, a click marks a pixel.</p>
  <p><a class="link" href="#">link to this view</a> <span class="copied" role="status"></span></p>
</aside>`;
  const find = (selector) => dialog.querySelector(selector);
  const [stage, message, valued] = [".stage", ".message", ".valued"].map(find);
  const zoomed = find("output.zoom");

  const state = { entry: null, kind: "technique", pixel: null, hover: null, exposure: 0, decades: {}, all: false };
  let values = null;
  let painted = new Map();
  let pictures = {};

  const errorKind = () => (state.kind in paint.errors ? state.kind : "angle");
  const scaleKind = () => (state.kind === "difference" ? "difference" : errorKind());
  const top = (kind) => (paint.errors[kind]?.top ?? 1) * 10 ** (state.decades[kind] || 0);
  const available = () =>
    KINDS.filter(({ kind }) =>
      state.entry && (state.entry.lone ? kind === "reference" : kind in state.entry.images || VALUES_ONLY.includes(kind)));

  // What a pane shows: painted from values, or as long as there are none, the page's own picture.
  const source = (kind) => {
    if (values && kind !== "levels") {
      if (!painted.has(kind)) {
        painted.set(kind, paint.picture(kind, values, { exposure: state.exposure, top: top(kind) }));
      }
      return painted.get(kind);
    }
    const picture = pictures[kind];
    return picture?.complete && picture.naturalWidth ? picture : null;
  };
  const view = makeView(stage, {
    source,
    marked: () => state.pixel,
    onHover: (pixel) => {
      if (String(pixel) === String(state.hover)) return;
      state.hover = pixel;
      showPixel();
    },
    onMark: (pixel) => mark(pixel),
    onChange: () => changed(),
  });

  const mark = (pixel) => {
    state.pixel = pixel;
    // On a touch screen nothing hovers.
    state.hover = null;
    showPixel();
    view.draw();
    changed();
  };

  // The loupe.
  const closeUps = () => {
    const error = VALUES_ONLY.includes(state.kind) || state.kind === "coverage" ? state.kind : "angle";
    return ["reference", "technique", error];
  };
  const closeUp = (pixel) => {
    const figures = closeUps().map((kind) => {
      const figure = document.createElement("figure");
      const canvas = document.createElement("canvas");
      const scale = 10 * Math.max(Math.round(window.devicePixelRatio || 1), 1);
      canvas.width = canvas.height = CLOSE_UP * scale;
      const context = canvas.getContext("2d");
      context.imageSmoothingEnabled = false;
      const corner = pixel.map((part) => (part - (CLOSE_UP - 1) / 2) * -scale);
      const picture = source(kind);
      if (picture) context.drawImage(picture, ...corner, view.size[0] * scale, view.size[1] * scale);
      const middle = (scale * (CLOSE_UP - 1)) / 2;
      for (const [color, width] of [["#000", 4], ["#fff", 2]]) {
        context.strokeStyle = color;
        context.lineWidth = width;
        context.strokeRect(middle, middle, scale, scale);
      }
      const caption = cell("figcaption", KINDS.find((known) => known.kind === kind).name);
      figure.append(canvas, caption);
      return figure;
    });
    find(".loupe").replaceChildren(...figures);
  };
  const showPixel = () => {
    const pixel = state.hover ?? state.pixel;
    const body = find(".values tbody");
    if (!pixel || state.entry.lone) {
      find(".pixel").textContent = "Point at the picture to read its values.";
      find(".loupe").replaceChildren();
      body.replaceChildren();
      return;
    }
    const [x, y] = pixel;
    find(".pixel").textContent = `pixel ${x}, ${y}`;
    if (!state.hover) find(".pixel").append(cell("span", " (marked)"));
    closeUp(pixel);
    if (!values) {
      body.replaceChildren();
      return;
    }
    body.replaceChildren(...loupe.rows(values, pixel));
  };

  // The error over the mirror.
  const count = (planes, code) => planes.reduce((sum, found) => sum + (found === code), 0);
  const showSpread = () => {
    const kind = errorKind();
    const { label } = paint.errors[kind];
    const summary = values.technique.errors[kind];
    const write = withUnit(kind);
    const worst = find("[data-do=worst]");
    worst.disabled = !summary;
    worst.textContent = summary ? `go to the worst pixel: ${label} ${write(summary.max)}` : `no ${label} anywhere`;
    find(".spread").textContent = `${label} over the mirror`;
    find(".spread").append(cell("span", " (heights: root of the number of pixels)"));
    histogram.draw(find(".histogram"), kind, values, summary, top(kind), write);
    const named = [["median", "p50"], ["95 %", "p95"], ["99 %", "p99"], ["largest", "max"]];
    find(".percentiles").replaceChildren(...(summary ? named : []).map(([name, key]) => {
      const button = cell("button", `${name} ${write(summary[key])}`, `${kind}.${key}`);
      button.type = "button";
      button.title = "go to a pixel with this error";
      button.addEventListener("click", () => goTo(key === "max" ? summary.worst : nearest(kind, summary[key])));
      return button;
    }));
    const { coverage, status } = values.technique.planes;
    const all = coverage.reduce((sum, code) => sum + !Number.isNaN(code), 0);
    const shares = paint.look.coverage.map(({ name }, code) => [name, count(coverage, code)]);
    const parts = shares.filter(([, found]) => found).map(([name, found]) => `${name} ${number((100 * found) / all)} %`);
    const known = kind === "angle" ? `The angle is known at ${summary?.pixels ?? 0} of ${all} mirror pixels: where both show the same object. ` : "";
    find(".covered").textContent = all ? `${known}Of the mirror pixels: ${parts.join(", ")}.` : `No pixel of ${status.length} shows a mirror.`;
    const { steps } = values.technique;
    const relative = 100 * (2 ** steps.angle.step - 1);
    find(".steps").textContent =
      `Values are stored in steps: colour 1/${Math.round(1 / steps.color.step)}, angle ${number(relative)} %, FLIP 1/${Math.round(1 / steps.flip.step)}. The worst pixel and the percentiles are from exact values. ` +
      (steps.offset ? "" : "Positions and offsets are stored by --layers.");
  };
  const nearest = (kind, value) => {
    const found = paint.error(kind, values);
    let best = -1;
    for (let i = 0; i < found.length; i++) {
      if (best < 0 ? !Number.isNaN(found[i]) : Math.abs(found[i] - value) < Math.abs(found[best] - value)) best = i;
    }
    return [best % values.size[0], Math.floor(best / values.size[0])];
  };
  const goTo = (pixel) => {
    if (!pixel) return;
    state.hover = null;
    state.pixel = pixel;
    view.lookAt(pixel.map((part) => part + 0.5), Math.max(view.zoom, 16));
    showPixel();
  };

  // Controls.
  const showControls = () => {
    const { entry } = state;
    find("[name=scene]").value = entry.lone ? "" : group(entry);
    find("[name=technique]").value = entry.lone ? "" : String(entries.indexOf(entry));
    for (const which of dialog.querySelectorAll(".which, .kinds, [data-do=all]")) which.hidden = Boolean(entry.lone);
    for (const button of dialog.querySelectorAll("[data-kind]")) {
      button.hidden = !available().some(({ kind }) => kind === button.dataset.kind);
      button.disabled = valued.hidden && VALUES_ONLY.includes(button.dataset.kind);
      button.setAttribute("aria-pressed", button.dataset.kind === state.kind);
    }
    find("[data-do=all]").setAttribute("aria-pressed", state.all);
    find("[name=exposure]").value = state.exposure;
    find(".exposure output").textContent = `${state.exposure > 0 ? "+" : ""}${state.exposure} stops`;
    const kind = scaleKind();
    const slider = find("[name=top]");
    [slider.min, slider.max] = SCALES[kind];
    slider.value = state.decades[kind] || 0;
    find(".top span").textContent = `scale of ${kind === "difference" ? "the difference" : paint.errors[kind].label}`;
    find(".top output").textContent = `up to ${withUnit(kind)(top(kind))}`;
    showLegend(kind);
  };
  // What the colours of the picture mean.
  const showLegend = (kind) => {
    const legend = find(".sliders .legend");
    if (state.kind === "coverage") {
      legend.replaceChildren(...paint.look.coverage.filter(({ color }) => color).map(({ name, color }) => {
        const element = cell("span", name);
        element.prepend(swatch(`#${color}`));
        return element;
      }));
      return;
    }
    const high = top(kind);
    const { decades } = paint.errors[kind] ?? {};
    const low = decades ? high / 10 ** decades : kind === "difference" ? -high : 0;
    const middle = decades ? Math.sqrt(low * high) : (low + high) / 2;
    const bar = document.createElement("div");
    bar.className = "ramp";
    const stops = [...Array(17).keys()].map((stop) => {
      const value = decades ? low * (high / low) ** (stop / 16) : (high * stop) / 16;
      return paint.css(kind, value, high);
    });
    bar.style.background = `linear-gradient(to right, ${kind === "difference" ? "#000, #fff" : stops.join(", ")})`;
    const ticks = document.createElement("div");
    ticks.className = "ticks";
    ticks.append(...[low, middle, high].map((value) => cell("span", withUnit(kind)(value))));
    legend.replaceChildren(bar, ticks);
  };
  const showPanes = () => {
    const { entry } = state;
    const named = (known) => (known.kind === "technique" ? { ...known, name: entry.technique } : known);
    const wanted = available().filter(({ kind }) => (state.all ? values || !VALUES_ONLY.includes(kind) : kind === state.kind));
    view.show(wanted.map(named));
  };
  const showMessage = (text) => {
    message.hidden = !text;
    message.textContent = text;
  };
  const repaint = () => {
    painted = new Map();
    refresh();
  };
  const refresh = () => {
    showControls();
    if (values) showSpread();
    showPixel();
    view.draw();
    changed();
  };

  // Where we are, as the page's address.
  let timer = 0;
  const address = () => {
    const { entry, pixel } = state;
    const parts = new URLSearchParams({
      scene: entry.scene,
      size: entry.size.join("x"),
      technique: entry.technique,
      picture: state.kind,
    });
    if (state.all) parts.set("all", "1");
    if (!view.fitted) {
      parts.set("zoom", Number(view.zoom.toPrecision(4)));
      parts.set("at", view.center.map((part) => Number(part.toFixed(2))).join(","));
    }
    if (pixel) parts.set("pixel", pixel.join(","));
    if (state.exposure) parts.set("exposure", state.exposure);
    for (const [kind, by] of Object.entries(state.decades)) if (by) parts.set(`scale-${kind}`, by);
    return `#inspect&${String(parts).replaceAll("%2C", ",")}`;
  };
  const replace = (hash) => history.replaceState(null, "", hash);
  const changed = () => {
    zoomed.textContent = `${number(Number((100 * view.zoom).toPrecision(3)))} %`;
    if (!dialog.open || state.entry.lone) return;
    find(".link").href = address();
    clearTimeout(timer);
    timer = setTimeout(() => dialog.open && !state.entry.lone && replace(address()), 200);
  };
  const pair = (text) => {
    const parts = (text ?? "").split(",").map(Number);
    return parts.length === 2 && parts.every(Number.isFinite) ? parts : null;
  };
  const restore = () => {
    if (!location.hash.startsWith("#inspect&")) {
      if (dialog.open) dialog.close();
      return;
    }
    const parts = new URLSearchParams(location.hash.slice("#inspect&".length));
    const [scene, technique, size] = ["scene", "technique", "size"].map((name) => parts.get(name));
    const known = entries.filter((entry) => entry.scene === scene);
    const entry =
      known.find((other) => other.technique === technique && other.size.join("x") === size) ??
      known.find((other) => other.technique === technique) ?? known[0] ?? entries[0];
    if (!entry) return;
    const kind = KINDS.some((other) => other.kind === parts.get("picture")) ? parts.get("picture") : "technique";
    Object.assign(state, { exposure: Number(parts.get("exposure")) || 0, all: parts.has("all"), decades: {} });
    for (const name of Object.keys(SCALES)) state.decades[name] = Number(parts.get(`scale-${name}`)) || 0;
    show(entry, kind, { keep: false });
    const pixel = pair(parts.get("pixel"));
    if (pixel && pixel.every((part, axis) => part >= 0 && part < entry.size[axis])) state.pixel = pixel.map(Math.floor);
    const at = pair(parts.get("at"));
    if (at) view.lookAt(at, Math.min(Math.max(Number(parts.get("zoom")) || 1, 0.05), 96));
    showPixel();
    view.draw();
    if (entry.scene !== scene || entry.technique !== technique) {
      showMessage(`This page has no pictures of ${technique} on ${scene}, which the link names.`);
    }
  };

  // Shows an entry; with `keep`, the zoom, the place and the marked pixel stay.
  const show = (entry, kind, { keep }) => {
    const same = keep && state.entry && String(entry.size) === String(state.entry.size);
    state.entry = entry;
    state.kind = kind;
    state.hover = null;
    if (!available().some((known) => known.kind === kind)) state.kind = "reference";
    values = null;
    painted = new Map();
    pictures = {};
    for (const [name, image] of Object.entries(entry.images)) {
      const copy = new Image();
      copy.addEventListener("load", () => state.entry === entry && refresh());
      copy.src = image.getAttribute("src");
      pictures[name] = copy;
    }
    if (!dialog.open) {
      dialog.showModal();
      document.documentElement.classList.add("inspecting");
    }
    stage.focus({ preventScroll: true });
    find(".by").textContent = entry.technique;
    valued.hidden = false;
    dialog.classList.toggle("lone", Boolean(entry.lone));
    view.size = entry.size;
    showControls();
    showPanes();
    if (!same) {
      state.pixel = null;
      view.fit();
    }
    showMessage("");
    valued.classList.add("waiting");
    find("[data-do=worst]").textContent = "the values are being read";
    refresh();
    if (entry.lone) return;
    layers.load(entry).then((found) => {
      if (state.entry !== entry) return;
      values = found;
      valued.classList.remove("waiting");
      showPanes();
      repaint();
    }, (error) => {
      if (state.entry !== entry) return;
      valued.hidden = true;
      showKind(VALUES_ONLY.includes(state.kind) ? "technique" : state.kind);
      showMessage(`The values of ${entry.technique} on ${entry.scene} cannot be read: ${error.message}. The pictures are shown as they are on the page.`);
    });
  };
  const showKind = (kind) => {
    // Without values there is nothing to paint it from; why, the message says.
    if (VALUES_ONLY.includes(kind) && valued.hidden) return;
    if (!available().some((known) => known.kind === kind)) return;
    state.all = false;
    state.kind = kind;
    showControls();
    showPanes();
    refresh();
  };
  const among = (list, now, by) => list[(list.indexOf(now) + by + list.length) % list.length];
  const moveTechnique = (by) => {
    const beside = entries.filter((entry) => group(entry) === group(state.entry));
    show(among(beside, state.entry, by), state.kind, { keep: true });
  };
  const toScene = (name) => {
    const there = entries.filter((entry) => group(entry) === name);
    const same = there.find((entry) => entry.technique === state.entry.technique);
    show(same ?? there[0], state.kind, { keep: false });
  };
  const movePixel = (by) => {
    const from = state.pixel ?? view.center.map(Math.floor);
    const to = from.map((part, axis) => Math.min(Math.max(part + by[axis], 0), view.size[axis] - 1));
    mark(to);
    const [wide, high] = [stage.clientWidth, stage.clientHeight].map((side) => side / view.zoom / 2 - 1);
    const outside = Math.abs(to[0] + 0.5 - view.center[0]) > wide || Math.abs(to[1] + 0.5 - view.center[1]) > high;
    if (outside) view.lookAt(to.map((part) => part + 0.5));
  };
  const close = () => {
    dialog.close();
  };
  dialog.addEventListener("close", () => {
    clearTimeout(timer);
    document.documentElement.classList.remove("inspecting");
    if (location.hash.startsWith("#inspect&")) replace("#");
  });

  const actions = {
    back: () => moveTechnique(-1),
    next: () => moveTechnique(1),
    in: () => view.zoomTo(view.zoom * 1.5, focus()),
    out: () => view.zoomTo(view.zoom / 1.5, focus()),
    fit: () => {
      view.fit();
      changed();
    },
    all: () => {
      state.all = !state.all;
      showControls();
      showPanes();
      view.fit();
      changed();
    },
    worst: () => values && goTo(values.technique.errors[errorKind()]?.worst),
    reset: () => {
      Object.assign(state, { exposure: 0, decades: {} });
      repaint();
    },
    close,
  };
  // Zoom by keys and buttons is about the marked pixel, where it is in view.
  const focus = () => {
    if (!state.pixel) return view.center;
    const point = state.pixel.map((part) => part + 0.5);
    const half = [stage.clientWidth, stage.clientHeight].map((side) => side / view.zoom / 2);
    return point.every((part, axis) => Math.abs(part - view.center[axis]) < half[axis]) ? point : view.center;
  };

  KINDS.forEach(({ kind, name }, place) => {
    const button = cell("button", name);
    button.type = "button";
    button.dataset.kind = kind;
    button.title = `${name} (${place + 1})`;
    button.addEventListener("click", () => showKind(kind));
    find(".kinds").append(button);
  });
  for (const button of dialog.querySelectorAll("[data-do]")) {
    button.addEventListener("click", () => actions[button.dataset.do]());
  }
  const options = (list) => list.map(([value, text]) => new Option(text, value));
  const sizes = new Map(entries.map((entry) => [group(entry), entry]));
  const several = (entry) => groups.filter((name) => sizes.get(name).scene === entry.scene).length > 1;
  find("[name=scene]").append(...options(groups.map((name) => {
    const entry = sizes.get(name);
    return [name, several(entry) ? name : entry.scene];
  })));
  for (const name of groups) {
    const part = document.createElement("optgroup");
    part.label = name;
    const inside = entries.map((entry, place) => [place, entry.technique]).filter(([place]) => group(entries[place]) === name);
    part.append(...options(inside));
    find("[name=technique]").append(part);
  }
  find("[name=scene]").addEventListener("change", (event) => toScene(event.target.value));
  find("[name=technique]").addEventListener("change", (event) => show(entries[event.target.value], state.kind, { keep: true }));
  find("[name=exposure]").addEventListener("input", (event) => {
    state.exposure = Number(event.target.value);
    repaint();
  });
  find("[name=top]").addEventListener("input", (event) => {
    state.decades[scaleKind()] = Number(event.target.value);
    repaint();
  });
  find(".link").addEventListener("click", (event) => {
    event.preventDefault();
    const link = new URL(address(), location.href).href;
    const said = (text) => (find(".copied").textContent = text);
    const copied = navigator.clipboard?.writeText(link) ?? Promise.reject(new Error("no clipboard"));
    copied.then(() => said("copied"), () => said("it is in the address bar"));
    replace(address());
  });

  dialog.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select, input")) return;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const by = arrows[event.key];
    const keys = { "+": "in", "=": "in", "-": "out", "−": "out", 0: "fit", a: "all", w: "worst" };
    if (by && event.shiftKey) movePixel(by);
    else if (by && state.entry.lone) return;
    else if (by && by[0]) moveTechnique(by[0]);
    else if (by) toScene(among(groups, group(state.entry), by[1]));
    else if (KINDS[event.key - 1] && !state.entry.lone) showKind(KINDS[event.key - 1].kind);
    else if (keys[event.key.toLowerCase()]) actions[keys[event.key.toLowerCase()]]();
    else return;
    event.preventDefault();
  });

  // From the page into the inspector.
  const open = (image) => {
    const box = image.closest("[data-layers]");
    const entry = box && entries.find((known) => known.layers === box.dataset.layers);
    const size = ["width", "height"].map((side) => Number(image.getAttribute(side)));
    const lone = { lone: true, scene: image.alt, technique: "", size, images: { reference: image } };
    Object.assign(state, { exposure: 0, decades: {}, all: false });
    // Where one picture lies on the other, the technique's is on top.
    const wiped = image.closest(".compare")?.dataset.mode === "wipe";
    const kind = wiped ? "technique" : image.dataset.picture;
    if (entry) history.pushState(null, "", "#inspect&");
    show(entry ?? lone, entry ? kind : "reference", { keep: false });
  };
  for (const image of document.querySelectorAll("main figure > img")) {
    image.classList.add("opens");
    image.title ||= "click to look into it";
    image.addEventListener("click", () => open(image));
  }
  for (const box of document.querySelectorAll(".compare[data-layers], [data-layers] .compare")) {
    const button = cell("button", "look into it");
    button.type = "button";
    button.title = "zoom, values of pixels, worst pixel";
    button.addEventListener("click", () => open(box.querySelector(".tech img")));
    box.querySelector(".controls").append(button);
  }
  document.body.append(dialog);
  window.addEventListener("popstate", restore);
  window.addEventListener("hashchange", restore);
  if (location.hash.startsWith("#inspect&")) restore();
  return { restore };
})();
