// Values of pictures, read from the scripts beside the page. How they are written is said in
// `crates/harness/src/show/layers/`.
const layers = (() => {
  // Decoded files by path, the latest last: so many stay in memory.
  const kept = new Map();
  const MOST = 10;

  // Each file calls this with its content.
  window.catoptricLayers = (file) => {
    document.currentScript.content = file;
  };

  const read = (path) =>
    new Promise((done, failed) => {
      const script = document.createElement("script");
      const end = () => {
        script.remove();
        if (script.content) done(script.content);
        else failed(new Error(`${path} is missing or damaged`));
      };
      script.addEventListener("load", end);
      script.addEventListener("error", end);
      script.src = path;
      document.head.append(script);
    });

  const inflate = async (text) => {
    const packed = Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };

  const codes = async (plane, [width, height], truth) => {
    const { bytes: deep, channels, predict } = plane;
    const bytes = await inflate(plane.data);
    const count = width * height * channels;
    if (bytes.length !== count * deep) throw new Error("a plane has another size");
    const mask = deep < 4 ? 2 ** (8 * deep) - 1 : -1;
    const [next, step] = channels > 1 ? [1, deep] : [count, 1];
    const row = width * channels;
    const found = new Uint32Array(count);
    for (let i = 0; i < count; i++) {
      let folded = 0;
      for (let part = deep - 1; part >= 0; part--) folded = (folded << 8) | bytes[part * next + i * step];
      const difference = (folded >>> 1) ^ -(folded & 1);
      const before = i % row >= channels ? i - channels : i >= row ? i - row : -1;
      let predicted = 0;
      if (predict !== "reference" && before >= 0) predicted = found[before];
      if (predict === "reference") predicted = truth[i];
      else if (predict === "change") predicted += truth[i] - (before >= 0 ? truth[before] : 0);
      found[i] = (predicted + difference) & mask;
    }
    return found;
  };

  const meaning = (plane) => {
    const last = 2 ** (8 * plane.bytes) - 1;
    if (plane.code === "octaves") {
      return (code) => (code < 2 ? (code ? 0 : NaN) : 2 ** (plane.from + plane.step * (code - 2)));
    }
    const { from, step } = plane.code === "linear" ? plane : { from: 0, step: 1 };
    return (code) => (code === last ? NaN : from + step * code);
  };

  const decode = async (path, truth) => {
    const file = await read(path);
    const { of, size, planes, errors } = file;
    const result = { of, size, errors, names: new Map(file.names), codes: {}, planes: {}, steps: {} };
    for (const [name, plane] of Object.entries(planes)) {
      const found = await codes(plane, size, truth && truth.codes[name]);
      result.codes[name] = found;
      const value = meaning(plane);
      const { channels } = plane;
      const names = channels === 3 ? ["r", "g", "b"].map((part) => `${name}.${part}`) : [name];
      names.forEach((part, channel) => {
        const values = new Float64Array(found.length / channels);
        for (let i = 0; i < values.length; i++) values[i] = value(found[i * channels + channel]);
        result.planes[part] = values;
      });
      result.steps[name] = plane;
      delete plane.data;
    }
    // Only the truth's are asked for again.
    if (truth) result.codes = {};
    return result;
  };

  const once = (path, truth) => {
    const known = kept.get(path) || decode(path, truth);
    kept.delete(path);
    kept.set(path, known);
    // What failed may be there at the next try.
    known.catch(() => kept.delete(path));
    for (const old of [...kept.keys()].slice(0, -MOST)) kept.delete(old);
    return known;
  };

  // The values of a technique's picture and of its truth.
  const load = async (entry) => {
    try {
      const truth = await once(entry.truth);
      const technique = await once(entry.layers, truth);
      if (String(truth.size) !== String(technique.size)) throw new Error(`${entry.layers} has another size`);
      return { truth, technique, size: truth.size };
    } catch (error) {
      const files = error.message.includes(".js") ? "" : ` (${entry.truth}, ${entry.layers})`;
      throw new Error(error.message + files);
    }
  };
  return { load };
})();
