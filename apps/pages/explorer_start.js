"use strict";
// First what is seen first.
const loadAll = async () => {
  if (typeof DecompressionStream === "undefined") throw new Error("This browser cannot unpack the pictures: it takes Chrome 86, Firefox 113, Safari 16.4 or later.");
  for (const s of all) await s.load(state.i);
  draw();
  for (const s of all) for (let i = 0; i < s.heads.length; ++i) if (!s.planes[i]) { await s.load(i); paintTiles(); }
  draw();
  document.body.dataset.ready = "yes";
};
drawWords();
drawNotes();
readAddress();
loadAll().then(watchRender).catch(e => { $("warnings").append(element("p", e.message, "warning")); });
