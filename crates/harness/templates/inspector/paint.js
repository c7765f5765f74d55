// Pictures painted from values: exposure and scales can change.
const paint = (() => {
  const look = JSON.parse(document.getElementById("inspector-look").textContent);
  const table = (hex) => Uint8Array.from(hex.match(/../g), (byte) => parseInt(byte, 16));
  const magma = table(look.magma);
  const NONE = -1;

  // sRGB codes of linear values from 0 to 1.
  const FINE = 8192;
  const srgb = new Uint8Array(FINE + 1);
  for (let i = 0; i <= FINE; i++) {
    const linear = i / FINE;
    const coded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
    srgb[i] = Math.round(255 * coded);
  }
  const shown = (linear) => srgb[Math.round(FINE * Math.min(Math.max(linear || 0, 0), 1))];
  const rgb = (layer) => ["r", "g", "b"].map((part) => layer.planes[`color.${part}`]);

  // Whether both see a reflecting mirror there: where errors are looked at.
  const reflecting = (status) => status === look.resolved || status === look.unresolved;
  const mirror = (values, i) =>
    reflecting(values.truth.planes.status[i]) && reflecting(values.technique.planes.status[i]);

  // Errors with a scale: from black at no error to light yellow at `top` and above.
  const errors = {
    angle: { label: "angular error", unit: "°", top: look.angles[1], decades: Math.log10(look.angles[1] / look.angles[0]) },
    color: { label: "colour error", unit: "", top: 1 },
    flip: { label: "FLIP", unit: "", top: 1 },
  };

  // An error at every pixel; NaN where there is none.
  const error = (kind, values) => {
    const stored = values.technique.planes[kind];
    if (stored) return stored;
    values.color ||= (() => {
      const [a, b] = [rgb(values.truth), rgb(values.technique)];
      const found = new Float64Array(a[0].length).fill(NaN);
      for (let i = 0; i < found.length; i++) {
        if (!mirror(values, i)) continue;
        const off = (channel) => Math.abs(b[channel][i] - a[channel][i]);
        found[i] = (off(0) + off(1) + off(2)) / 3;
      }
      return found;
    })();
    return values.color;
  };

  // Where on its scale an error lies, from 0 to 1.
  const place = (kind, value, top) => {
    const { decades } = errors[kind];
    const at = decades ? 1 + Math.log10(value / top) / decades : value / top;
    return Math.min(Math.max(at, 0), 1);
  };

  const canvas = ([width, height], pixel) => {
    const picture = document.createElement("canvas");
    Object.assign(picture, { width, height });
    const context = picture.getContext("2d");
    const data = context.createImageData(width, height);
    const words = new Uint32Array(data.data.buffer);
    for (let i = 0; i < words.length; i++) words[i] = pixel(i);
    context.putImageData(data, 0, 0);
    return picture;
  };
  // As the bytes lie in memory: red first.
  const pack = (r, g, b) => ((255 << 24) | (b << 16) | (g << 8) | r) >>> 0;
  const ramp = Array.from({ length: 256 }, (_, i) => pack(...magma.subarray(3 * i, 3 * i + 3)));

  // The truth without colour or contrast, where a map has nothing to say.
  const pale = (values) => {
    const [r, g, b] = rgb(values.truth);
    const [low, high] = look.pale;
    return (i) => {
      const luma = shown(0.2126 * r[i] + 0.7152 * g[i] + 0.0722 * b[i]) / 255;
      const grey = Math.round(low + luma * (high - low));
      return pack(grey, grey, grey);
    };
  };

  const picture = (kind, values, { exposure, top }) => {
    const { size, truth, technique } = values;
    if (kind === "reference" || kind === "technique") {
      const [r, g, b] = rgb(kind === "reference" ? truth : technique);
      const gain = 2 ** exposure;
      return canvas(size, (i) => pack(shown(gain * r[i]), shown(gain * g[i]), shown(gain * b[i])));
    }
    if (kind === "difference") {
      const [a, b] = [rgb(truth), rgb(technique)];
      const grey = (channel, i) => {
        const half = (b[channel][i] - a[channel][i]) / top / 2;
        return Math.round(255 * Math.min(Math.max(0.5 + half, 0), 1)) || 0;
      };
      return canvas(size, (i) => pack(grey(0, i), grey(1, i), grey(2, i)));
    }
    const under = pale(values);
    if (kind === "coverage") {
      const colors = look.coverage.map(({ color }) => (color ? pack(...table(color)) : NONE));
      const codes = technique.planes.coverage;
      return canvas(size, (i) => {
        const color = colors[codes[i]] ?? NONE;
        return color === NONE ? under(i) : color;
      });
    }
    const found = error(kind, values);
    return canvas(size, (i) =>
      Number.isNaN(found[i]) ? under(i) : ramp[Math.round(255 * place(kind, found[i], top))]);
  };

  const css = (kind, value, top) => {
    if (!(kind in errors)) return "#808080";
    const at = 3 * Math.round(255 * place(kind, value, top));
    return `rgb(${magma.subarray(at, at + 3).join(",")})`;
  };
  return { look, errors, error, mirror, picture, css, shown, rgb };
})();
