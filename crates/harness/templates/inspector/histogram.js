// How an error is distributed over the mirror.
const histogram = (() => {
  const BARS = 48;
  const SVG = "http://www.w3.org/2000/svg";
  const make = (name, attributes, parent) => {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    parent.append(element);
    return element;
  };

  // Draws into `svg`; `number` writes a value with its unit. The answer is the values' range.
  const draw = (svg, kind, values, summary, top, number) => {
    svg.replaceChildren();
    const found = paint.error(kind, values).filter((value) => !Number.isNaN(value));
    if (!found.length) return;
    const log = Boolean(paint.errors[kind].decades);
    let high = 0;
    let low = Infinity;
    for (const value of found) {
      if (value > high) high = value;
      if (value > 0 && value < low) low = value;
    }
    if (!high) [low, high] = [0.5, 1];
    if (log) [low, high] = [Math.min(low, high / 10), high * 1.0001];
    const at = (value) => {
      const place = log ? Math.log(Math.max(value, low) / low) / Math.log(high / low) : value / high;
      return Math.min(Math.max(place, 0), 1);
    };
    const counts = new Array(BARS).fill(0);
    for (const value of found) counts[Math.min(Math.floor(at(value) * BARS), BARS - 1)]++;
    const most = Math.max(...counts);
    counts.forEach((count, bar) => {
      if (!count) return;
      // As the root of the count: few pixels are seen beside many.
      const tall = Math.max(60 * Math.sqrt(count / most), 1);
      const ends = [bar, bar + 1].map((end) => (log ? low * (high / low) ** (end / BARS) : (high * end) / BARS));
      const middle = log ? Math.sqrt(ends[0] * ends[1]) : (ends[0] + ends[1]) / 2;
      const box = make("rect", {
        x: (240 * bar) / BARS, y: 62 - tall, width: 240 / BARS - 0.4, height: tall,
        fill: paint.css(kind, middle, top), class: "bar-of-errors",
      }, svg);
      make("title", {}, box).textContent = `${count} pixels from ${number(ends[0])} to ${number(ends[1])}`;
    });
    for (const [name, value] of [["median", summary?.p50], ["95 %", summary?.p95], ["99 %", summary?.p99]]) {
      if (value === undefined) continue;
      const x = 240 * at(value);
      const line = make("line", { x1: x, x2: x, y1: 0, y2: 64, class: "percentile" }, svg);
      make("title", {}, line).textContent = `${name}: ${number(value)}`;
    }
    const labels = log ? [low, Math.sqrt(low * high), high] : [0, high / 2, high];
    labels.forEach((value, place) => {
      const anchor = ["start", "middle", "end"][place];
      make("text", { x: 120 * place, y: 74, "text-anchor": anchor }, svg).textContent = number(value);
    });
  };
  return { draw };
})();
