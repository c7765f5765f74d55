// The loupe's text: what reference and technique have at a pixel.
const loupe = (() => {
  const number = (value) => {
    if (value === undefined || Number.isNaN(value)) return "–";
    if (value === 0) return "0";
    const size = Math.abs(value);
    return size >= 1e4 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
  };
  const withUnit = (kind) => (value) => number(value) + (paint.errors[kind]?.unit ?? "");
  const cell = (tag, text, name) => {
    const element = document.createElement(tag);
    if (tag === "th") element.scope = "row";
    element.textContent = text;
    if (name) element.dataset.value = name;
    return element;
  };
  const line = (label, ...cells) => {
    const row = document.createElement("tr");
    row.append(cell("th", label), ...cells);
    return row;
  };
  const swatch = (color) => {
    const element = document.createElement("span");
    element.className = "swatch";
    element.style.background = color;
    return element;
  };
  const css = (linear) => `rgb(${linear.map((part) => paint.shown(part)).join(",")})`;
  const three = (parts) => (parts.some(Number.isNaN) ? "–" : parts.map(number).join(", "));

  // Rows of the table about a pixel.
  const rows = (values, pixel) => {
    const i = pixel[1] * values.size[0] + pixel[0];
    const objectName = (id) => (id ? values.truth.names.get(id) ?? "unnamed" : "background");
    const { truth, technique } = values;
    const both = [["reference", truth], ["technique", technique]];
    const at = (layer, name) => layer.planes[name]?.[i];
    const vector = (layer, name) => ["x", "y", "z"].map((axis) => at(layer, `${name}.${axis}`));
    const colors = both.map(([, layer]) => paint.rgb(layer).map((part) => part[i]));
    const isMirror = both.map(([, layer]) => at(layer, "status") !== paint.look.none);
    const found = [
      line("object", ...both.map(([name, layer], place) =>
        cell("td", isMirror[place] ? objectName(at(layer, "id")) : "no mirror here", `${name}.object`))),
      line("id", ...both.map(([name, layer]) => cell("td", String(at(layer, "id")), `${name}.id`))),
      line("status", ...both.map(([name, layer]) =>
        cell("td", paint.look.statuses[at(layer, "status")] ?? "–", `${name}.status`))),
      line("colour (linear)", ...both.map(([name], place) => {
        const parts = colors[place];
        const element = cell("td", parts.map((part) => (Number.isNaN(part) ? "–" : part.toFixed(4))).join(" "), `${name}.color`);
        element.prepend(swatch(css(parts)));
        return element;
      })),
    ];
    if (truth.planes["position.x"]) {
      found.push(line("position", ...both.map(([name, layer]) => cell("td", three(vector(layer, "position")), `${name}.position`))));
      found.push(line("distance", ...both.map(([name, layer]) => cell("td", number(at(layer, "distance")), `${name}.distance`))));
      const first = [["primary.position", "mirror's point"], ["primary.normal", "its normal"]];
      for (const [plane, label] of first) {
        found.push(line(label, cell("td", three(vector(truth, plane)), plane), cell("td", "")));
      }
    }
    const wide = (label, text, name) => {
      const data = cell("td", text, name);
      data.colSpan = 2;
      return line(label, data);
    };
    const seen = at(truth, "primary.id");
    found.push(wide(isMirror[0] ? "mirror" : "seen directly", `${objectName(seen)} (id ${seen})`, "primary"));
    // At the worst pixel, the value is known as it was before it was stored.
    const exact = (kind) => {
      const summary = technique.errors[kind];
      return String(summary?.worst) === String(pixel) ? summary.max : paint.error(kind, values)[i];
    };
    const angle = exact("angle");
    const noAngle = isMirror.every(Boolean) ? "– (not the same object)" : "–";
    found.push(wide("angular error", Number.isNaN(angle) ? noAngle : withUnit("angle")(angle), "angle"));
    const coverage = paint.look.coverage[at(technique, "coverage")];
    found.push(wide("coverage", coverage ? coverage.name : "–", "coverage"));
    found.push(wide("colour error", number(exact("color")), "color"));
    found.push(wide("FLIP", number(exact("flip")), "flip"));
    const difference = colors[1].map((part, channel) => part - colors[0][channel]);
    const signed = (part) => (part > 0 ? "+" : "") + part.toFixed(4).replace("-", "−");
    found.push(wide("difference", difference.map(signed).join(" "), "difference"));
    if (technique.planes.offset) found.push(wide("offset (pixels)", number(at(technique, "offset")), "offset"));
    return found;
  };
  return { number, withUnit, cell, swatch, rows };
})();
