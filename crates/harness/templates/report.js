// Wipe and flip between reference and technique; without script they stand side by side.
for (const box of document.querySelectorAll(".compare")) {
  const line = document.createElement("div");
  line.className = "line";
  const controls = document.createElement("div");
  controls.className = "controls";
  const slider = document.createElement("input");
  Object.assign(slider, { type: "range", min: 0, max: 100, step: 0.1, value: 50 });
  slider.setAttribute("aria-label", "Place of the line between reference and technique");
  const image = box.querySelector(".ref img");
  const measure = () => box.style.setProperty("--high", image.clientHeight + "px");
  const wipe = (at) => {
    slider.value = at;
    box.style.setProperty("--at", slider.value + "%");
  };
  const buttons = [["side", "side by side"], ["wipe", "wipe"], ["flip", "flip"]].map(([mode, label]) => {
    const button = document.createElement("button");
    button.type = "button";
    button.dataset.mode = mode;
    button.textContent = label;
    button.addEventListener("click", () => {
      // A second press on flip changes the picture.
      if (mode === "flip" && box.dataset.mode === "flip") box.classList.toggle("flipped");
      else show(mode);
    });
    return button;
  });
  const show = (mode) => {
    box.dataset.mode = mode;
    box.classList.remove("flipped");
    slider.hidden = mode !== "wipe";
    for (const button of buttons) button.setAttribute("aria-pressed", button.dataset.mode === mode);
    measure();
  };
  slider.addEventListener("input", () => wipe(slider.value));
  const drag = (event) => {
    if (box.dataset.mode !== "wipe" || (event.pointerType !== "mouse" && !event.buttons)) return;
    const area = image.getBoundingClientRect();
    wipe((100 * (event.clientX - area.left)) / area.width);
  };
  image.addEventListener("pointermove", drag);
  image.addEventListener("pointerdown", drag);
  new ResizeObserver(measure).observe(image);
  controls.append(...buttons, slider);
  box.append(line, controls);
  show(box.dataset.start || "side");
}
