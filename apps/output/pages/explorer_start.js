"use strict";
const loadAll = async () => {
  if (typeof DecompressionStream === "undefined") throw new Error("This browser cannot unpack the pictures: it takes Chrome 86, Firefox 113, Safari 16.4 or later.");
  for (let i = 0; all.some(s => i < s.heads.length); ++i) {
    for (const s of all) if (i < s.heads.length) await s.load(i);
    i === state.i ? draw() : paintTiles();
  }
  draw();
  document.body.dataset.ready = "yes";
};
drawWords();
drawNotes();
readAddress();
loadAll().then(watchRender).catch(e => { $("warnings").append(element("p", e.message, "warning")); });
