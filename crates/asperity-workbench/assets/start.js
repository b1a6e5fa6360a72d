// What the folder holds: maps, specs and reports, the newest first.

import { html, useState, useEffect, useRef } from "./preact.js";
import { bytes as bytesOf, get } from "./server.js";
import { draw, read } from "./surface.js";

const date = seconds => new Date(1000 * seconds).toLocaleString([], { dateStyle: "medium", timeStyle: "short" });
const size = bytes => (bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

// A small picture of a map, fetched when it comes near the screen; nothing of a file that has none.
const Picture = ({ path }) => {
  const canvas = useRef(null);
  useEffect(() => {
    const watcher = new IntersectionObserver(([{ isIntersecting }]) => {
      if (!isIntersecting) return;
      watcher.disconnect();
      bytesOf("/api/picture", { path }).then(buffer => {
        if (!buffer.byteLength || !canvas.current) return;
        const map = read(buffer);
        draw(canvas.current, map);
        // Its points may be further apart along one axis.
        canvas.current.style.aspectRatio = `${map.nx * map.pixel[0]} / ${map.ny * map.pixel[1]}`;
        canvas.current.hidden = false;
      }, () => {});
    }, { rootMargin: "200px" });
    watcher.observe(canvas.current.parentElement);
    return () => watcher.disconnect();
  }, [path]);
  return html`<canvas ref=${canvas} hidden aria-hidden="true"></canvas>`;
};

export const Start = ({ vocabulary, begin, open, example, fail, chooseFile }) => {
  const [entries, setEntries] = useState(null);
  useEffect(() => {
    const load = () => get("/api/files").then(setEntries, fail);
    load();
    addEventListener("focus", load);
    return () => removeEventListener("focus", load);
  }, []);
  const report = path => `/${vocabulary.reports}/${path.split("/").map(encodeURIComponent).join("/")}`;
  const item = ({ path, what, modified, bytes }) => {
    if (what.type === "report") {
      return html`<li class="report">
        <a href=${report(`${path}/${what.page}`)} target="_blank" rel="noopener">
          ${what.picture && html`<img src=${report(`${path}/card.svg`)} alt="" loading="lazy" />`}
          <strong>${what.title}</strong></a>
        <p>${what.answer}</p><small>Report ${path}, ${date(modified)}</small></li>`;
    }
    const act = what.type === "spec" ? () => open(path) : () => begin(path);
    return html`<li>${what.type === "surface" && html`<${Picture} key=${path} path=${path} />`}<button type="button" class="entry" onClick=${act}><strong>${what.type === "spec" ? what.title : path}</strong></button>
      <small>${what.type === "spec" ? `Spec ${path}, [${what.kind}]` : `Surface, ${size(bytes)}`}, ${date(modified)}</small></li>`;
  };
  return html`<main class="start">
    <h1>May I use the statistical contact model (of Greenwood and Williamson's kind) on my surface?</h1>
    <section class="drop">
      <p>Drop a height map here (a file of an instrument, .npy, X3P, SDF, text), or <button type="button" onClick=${chooseFile}>choose a file</button>. It stays on this machine, in <code>${vocabulary.folder}</code>.</p>
      ${entries && !entries.some(entry => entry.path.startsWith("example/")) && html`<p>No map at hand? <button type="button" onClick=${example}>Open the example</button>: a fine steel finish, measured by interferometry.</p>`}
    </section>
    ${entries === null ? html`<p role="status">Reading the folder …</p>` : html`<ul class="entries">${entries.map(item)}</ul>`}
  </main>`;
};
