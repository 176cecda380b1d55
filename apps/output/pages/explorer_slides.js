"use strict";
// Slides: the picture and its formula fill the screen.

// Turns "K^3 L_e" into texts and elements: one character, or a group in braces, is a superscript after ^ and a subscript after _.
const raised = text => text.split(/([\^_]\{[^}]*\}|[\^_].)/).map(part =>
  "^_".includes(part[0] ?? " ") ? element(part[0] === "^" ? "sup" : "sub", part.slice(1).replace(/[{}]/g, "")) : part);
const slideFormula = (s, { i, sum }) => {
  const [K, source] = s.importance ? ["K*", "W_e"] : ["K", "L_e"];
  if (i > s.last) return `rest: Σ ${K}^i ${source}, i > ${s.last}`;
  return sum ? `Σ ${K}^i ${source}, i ≤ ${i}` : i === 0 ? source : i === 1 ? `${K} ${source}` : `${K}^{${i}} ${source}`;
};
const drawSlide = () => {
  document.body.dataset.slide = state.slide;
  document.body.classList.toggle("sliding", !!state.slide);
  $("slide-caption").hidden = $("leave").hidden = !state.slide;
  $("slide-caption").replaceChildren(comparing() ? `${pairOf(series(), other())}: ` : runName(series()), ...raised(slideFormula(series(), shown())));
};
const enterSlides = () => {
  set({ slide: "dark" });
  document.activeElement.blur();
  document.documentElement.requestFullscreen?.().catch(() => {});  // where this is not allowed, the slide fills the window
};
const leaveSlides = () => {
  set({ slide: "" });
  if (document.fullscreenElement) document.exitFullscreen();
};
document.addEventListener("fullscreenchange", () => { if (!document.fullscreenElement) leaveSlides(); });
$("slides").onclick = enterSlides;
$("leave").onclick = leaveSlides;
