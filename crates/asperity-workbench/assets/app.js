// The page: what is shown follows from the state; each change of the spec asks the server for its results.

import { html, render, useState, useEffect, useMemo, useRef, useErrorBoundary } from "./preact.js";
import { get, post, upload, events } from "./server.js";
import { state, listen, change, setValue, undo, redo, canUndo, canRedo, withValue } from "./state.js";
import { Controls, Dialog, WITH_REFERENCE, Words, lengthUnits } from "./controls.js";
import { Start } from "./start.js";
import { Surface } from "./surface.js";
import { Results, Details, Status, merged } from "./results.js";
import { Kept, MOST_KEPT, keep } from "./kept.js";

// A change while both models run does not end them, unless they take longer than this (ms): else a slider in motion would show nothing.
const PATIENCE = 400;

// The computation that follows the spec.
class Computation {
  constructor(show) {
    this.show = show;
    this.run = { results: null };
    this.abort = null;
    this.started = 0;
    this.isNext = false;
  }

  set(patch) {
    this.run = { ...this.run, ...patch };
    this.show(this.run);
  }

  // Of a spec; the last one of several in a row.
  follow(request) {
    this.request = request;
    const isBusy = this.abort !== null && this.run.stage === null && performance.now() - this.started < PATIENCE;
    this.set({ isOutdated: true });
    if (isBusy) this.isNext = true;
    else this.start();
  }

  cancel() {
    this.abort?.abort();
    this.abort = null;
    this.isNext = false;
    this.set({ isRunning: false, isCancelled: true, progress: null });
  }

  clear() {
    this.abort?.abort();
    this.abort = null;
    this.isNext = false;
    this.request = null;
    this.set({ results: null, isRunning: false, isCancelled: false, error: null, progress: null, isOutdated: false });
  }

  async start() {
    this.abort?.abort();
    const abort = new AbortController();
    const request = this.request;
    Object.assign(this, { abort, started: performance.now(), isNext: false });
    this.set({ isRunning: true, isCancelled: false, stage: null, progress: null });
    const isCurrent = () => this.abort === abort;
    try {
      await events("/api/analyse", request, abort.signal, (name, value) => {
        if (!isCurrent()) return;
        if (name === "progress") this.set({ progress: value });
        if (name !== "results") return;
        const { stage, results, elapsed_s: elapsed } = value;
        this.set({ results: merged(this.run.results, stage, results), stage, elapsed, error: null, isOutdated: this.isNext });
        performance.measure(`results-${stage}`, { start: this.started });
        if (this.isNext) this.start();
      });
      if (isCurrent()) {
        this.abort = null;
        this.set({ isRunning: false, progress: null });
      }
    } catch (error) {
      if (!isCurrent()) return;
      this.abort = null;
      if (error.name === "AbortError") return;
      if (this.isNext) return this.start();
      this.set({ error, isRunning: false, progress: null, isOutdated: true });
    }
  }
}

// A term that is marked in a report: its meaning while it is pointed at, focused or touched.
const Terms = ({ terms }) => {
  const box = useRef(null);
  const [id, setId] = useState(null);
  useEffect(() => {
    const termAt = event => event.target.closest?.(".term");
    const place = term => {
      setId(term.getAttribute("popovertarget").replace(/^term-/, ""));
      requestAnimationFrame(() => {
        const { left, bottom, top } = term.getBoundingClientRect();
        const { style, offsetWidth, offsetHeight } = box.current;
        style.left = `${Math.max(8, Math.min(left, innerWidth - offsetWidth - 8))}px`;
        style.top = `${bottom + offsetHeight + 8 > innerHeight ? Math.max(8, top - offsetHeight - 4) : bottom + 4}px`;
      });
    };
    const enter = event => { const term = termAt(event); if (term) place(term); };
    const leave = event => termAt(event) && setId(null);
    const escape = event => event.key === "Escape" && setId(null);
    const click = event => { if (termAt(event)) { event.preventDefault(); enter(event); } };
    const all = [["pointerover", enter], ["pointerout", leave], ["focusin", enter], ["focusout", leave], ["click", click], ["keydown", escape]];
    all.forEach(([name, act]) => document.addEventListener(name, act));
    return () => all.forEach(([name, act]) => document.removeEventListener(name, act));
  }, []);
  return html`<div ref=${box} class="meaning shown" role="tooltip" hidden=${!terms[id]}>${terms[id]}</div>`;
};

const copied = text => navigator.clipboard.writeText(text);

const SpecText = ({ close, fail }) => {
  const { spec, folder } = state();
  const [texts, setTexts] = useState(null);
  const [error, setError] = useState(null);
  const area = useRef(null);
  useEffect(() => { post("/api/text", { spec, folder }).then(setTexts, fail); }, []);
  const apply = () => post("/api/parse", { text: area.current.value }).then(({ spec: next }) => { change({ spec: next, waits: [] }); close(); }, setError);
  return html`<${Dialog} title="The spec of this page" close=${close}>
    ${texts && html`<textarea ref=${area} aria-label="Spec" spellcheck=${false} rows="24">${texts.toml}</textarea>
      ${error && html`<p class="error" role="alert">${error.message}</p>`}
      <p class="buttons"><button type="button" class="main" onClick=${apply}>Apply</button>
        <button type="button" onClick=${() => copied(area.current.value)}>Copy</button></p>`}
  <//>`;
};

const plain = title => title.toLowerCase().replaceAll(/[^\p{L}\p{N}]+/gu, "-").replaceAll(/^-+|-+$/g, "").slice(0, 60) || "my-surface";

// Saves the spec, or writes its report.
const Save = ({ isReport, vocabulary, close, refresh }) => {
  const { spec, folder, saved } = state();
  const name = useRef(null);
  const [run, setRun] = useState({});
  const last = saved?.path.split("/").at(-1).replace(/\.toml$/, "");
  // A spec that was opened may hold comments, which the page does not: it is replaced only where its name is asked for.
  const [chosen, setChosen] = useState(last === undefined ? plain(spec.title ?? "") : saved.isOpened ? `${last}-2` : last);
  const isOwn = chosen.replace(/\.toml$/, "") === last;
  const replaced = saved?.isOpened ? ", and replaces the spec of this name with its comments." : ", and replaces what this page has written there.";
  const save = async event => {
    event.preventDefault();
    const request = { spec, folder, name: name.current.value.replace(/\.toml$/, ""), state: saved?.state ?? null };
    setRun({ isRunning: true });
    try {
      let done = null;
      if (isReport) await events("/api/report", request, undefined, (kind, value) => (kind === "report" ? (done = value) : setRun({ isRunning: true, progress: value })));
      else done = await post("/api/save", request);
      change({ saved: { path: done.path, state: done.state } });
      setRun({ done });
      refresh();
    } catch (error) {
      setRun({ error });
    }
  };
  return html`<${Dialog} title=${isReport ? "Write the report" : "Save the spec"} close=${close}>
    ${run.done
      ? html`<p role="status">${isReport ? html`The report is written: <a href=${`/${vocabulary.reports}/${run.done.page}`} target="_blank" rel="noopener">open ${run.done.page}</a>. Its spec is ` : "Saved as "}<code>${run.done.path}</code>.</p>
          <p>The same in a terminal: <code>experiment run ${run.done.path}</code></p>`
      : html`<form onSubmit=${save}><label>Name <input ref=${name} type="text" value=${chosen} onInput=${event => setChosen(event.target.value)} required autofocus /></label>
          <p>${isReport ? "The report goes to " : "The spec goes to "}<code>${isReport ? `reports/${chosen}` : `${folder ? `${folder}/` : ""}${chosen}.toml`}</code>${isOwn ? replaced : "."}</p>
          ${run.error && html`<p class="error" role="alert">${run.error.key && html`<code>${run.error.key}</code>: `}${run.error.message}</p>`}
          <p class="buttons"><button class="main" disabled=${run.isRunning}>${isOwn ? "Replace" : isReport ? "Write" : "Save"}</button> ${run.isRunning && html`<span role="status">${run.progress ? `${run.progress.stage}, ${Math.round(100 * run.progress.done)} %` : "…"}</span>`}</p></form>`}
  <//>`;
};

const App = ({ vocabulary }) => {
  const [shown, setShown] = useState(state());
  const [run, setRun] = useState({ results: null });
  const [dialog, setDialog] = useState(null);
  const [message, setMessage] = useState(null);
  const [maps, setMaps] = useState({});
  const [refreshed, setRefreshed] = useState(0);
  const [isDragged, setDragged] = useState(false);
  const computation = useRef(null);
  const chooser = useRef(null);
  const [crash] = useErrorBoundary(error => console.error(error));
  if (computation.current === null) computation.current = new Computation(setRun);
  const fail = error => setMessage(error.message ?? String(error));

  useEffect(() => listen(setShown), []);
  const { spec, folder, kept, waits } = shown;
  const open = waits.filter(key => {
    const surfaces = Object.values(spec?.surface ?? {}).flatMap(surface => Object.values(surface));
    return surfaces.some(of => of[key.split(".")[0]] === undefined);
  });
  // What is only printed changes no result.
  const { title: _title, notes: _notes, ...computed } = spec ?? {};
  const request = spec && !open.length ? JSON.stringify({ computed, folder }) : null;
  useEffect(() => {
    setMessage(null);
    if (request) computation.current.follow({ spec, folder });
    else computation.current.clear();
  }, [request]);
  // A file that has changed on disk is another surface.
  const inputs = run.results?.inputs && JSON.stringify(run.results.inputs);
  useEffect(() => {
    if (!inputs) return undefined;
    const look = () => post("/api/inputs", { spec, folder }).then(found => {
      if (JSON.stringify(found.inputs) === inputs) return;
      setMessage("A file has changed on disk: its results are computed again.");
      computation.current.follow({ spec, folder });
    }, fail);
    addEventListener("focus", look);
    return () => removeEventListener("focus", look);
  }, [inputs, request]);
  useEffect(() => { document.title = spec ? `${spec.title ?? "Spec"} – Asperity workbench` : "Asperity workbench"; }, [spec?.title]);

  const begin = async path => {
    const { spec: first, folder: at, open: needed } = await post("/api/begin", { path });
    change({ spec: first, folder: at, waits: needed, saved: null }, { isNewPage: true });
  };
  const beside = async path => {
    const { spec: first, open: needed } = await post("/api/begin", { path });
    const [[name, keys]] = Object.entries(first.surface);
    const own = spec.surface[name] ? `${name}-${Object.keys(spec.surface).length + 1}` : name;
    const up = folder ? "../".repeat(folder.split("/").length) : "";
    const [[kind, of]] = Object.entries(keys);
    const file = kind === "file" ? { ...of, path: up + of.path } : { ...of, file: up + of.file };
    change({ spec: { ...spec, surface: { ...spec.surface, [own]: { [kind]: file } } }, waits: needed });
  };
  const openSpec = async path => {
    const found = await post("/api/open", { path });
    change({ spec: found.spec, folder: found.folder, waits: [], saved: { path, state: found.state, isOpened: true } }, { isNewPage: true });
  };
  const guarded = act => (...rest) => { setMessage(null); return act(...rest).catch(fail); };
  const dropped = guarded(async files => {
    let isFirst = !state().spec;
    for (const file of files) {
      setMessage(`Keeping ${file.name} …`);
      const { path } = await upload(file);
      setMessage(null);
      if (path.endsWith(".toml")) await openSpec(path);
      else if (isFirst) await begin(path);
      else setDialog({ kind: "dropped", path });
      isFirst = false;
    }
    setRefreshed(Date.now());
  });

  useEffect(() => {
    const over = event => { if (event.dataTransfer?.types.includes("Files")) { event.preventDefault(); setDragged(true); } };
    const leave = event => { if (!event.relatedTarget) setDragged(false); };
    const drop = event => { event.preventDefault(); setDragged(false); dropped([...event.dataTransfer.files]); };
    const keys = event => {
      const isText = event.target.matches?.("input[type=text], textarea");
      if (isText || !(event.ctrlKey || event.metaKey)) return;
      if (event.key === "z" && !event.shiftKey) { event.preventDefault(); undo(); }
      if (event.key === "y" || (event.key === "Z" && event.shiftKey)) { event.preventDefault(); redo(); }
    };
    const all = [["dragover", over], ["dragleave", leave], ["drop", drop], ["keydown", keys]];
    all.forEach(([name, act]) => addEventListener(name, act));
    return () => all.forEach(([name, act]) => removeEventListener(name, act));
  }, []);

  const isCompare = Boolean(spec?.compare);
  // Controls and surfaces follow the spec, not each step of a computation.
  const controls = useMemo(() => isCompare && html`<${Controls} context=${{ spec, vocabulary, error: run.error, maps, waits }} />`, [spec, run.error, maps, waits]);
  const close = () => {
    computation.current.clear();
    change({ spec: null, folder: "", waits: [], saved: null }, { isNewPage: true });
    post("/api/close", {}).catch(fail);
  };
  const keepThis = () => {
    keep();
    setMessage(`Kept, ${state().kept.length} of ${MOST_KEPT}: below the results they are laid over each other.`);
  };
  const python = guarded(async () => {
    const { python: text } = await post("/api/text", { spec, folder });
    await copied(text);
    setMessage("The Python program is copied.");
  });
  const unfit = isCompare ? Object.keys(spec.surface ?? {}).filter(name => maps[name]?.is_blocked) : [];
  const hasMap = isCompare && Object.values(spec.surface ?? {}).some(kinds => kinds.file || kinds.generate);
  const actions = {
    nearer: hasMap && !spec.compare.models && html` <button type="button" onClick=${() => setValue(["compare", "models"], WITH_REFERENCE)}>Run boundary elements</button>`,
  };
  const results = useMemo(() => html`<${Results} run=${{ results: run.results, isOutdated: run.isOutdated }} actions=${actions} />`, [run.results, run.isOutdated, spec]);
  const details = useMemo(() => html`<${Details} run=${{ results: run.results, isOutdated: run.isOutdated }} />`, [run.results, run.isOutdated]);
  const isReady = !run.isOutdated || Boolean(run.error);
  const heard = !run.isRunning && run.results ? run.results.cases.map(one => spoken(one)).join(" ") : "";
  const button = (text, act, isDisabled = false) => html`<button type="button" onClick=${act} disabled=${isDisabled}>${text}</button>`;

  if (crash) return html`<main class="start"><h1>The page has failed</h1><p role="alert">${String(crash)}. Your spec is in the address: <a href=${location.href} onClick=${() => location.reload()}>load it again</a>.</p></main>`;
  return html`<div class=${isDragged ? "dragged" : ""}>
    <button type="button" class="skip" onClick=${() => document.querySelector("main")?.focus()}>Skip to the results</button>
    <header><a class="home" href="#" onClick=${event => { event.preventDefault(); if (spec) close(); }}>Asperity</a>
      ${spec && html`<input class="title" type="text" aria-label="Title of the report" value=${spec.title ?? ""} onChange=${event => change({ spec: { ...spec, title: event.target.value } })} />
      <nav aria-label="Actions">
        ${button("Undo", undo, !canUndo())}${button("Redo", redo, !canRedo())}
        ${button("Keep", keepThis, !isCompare || kept.length >= MOST_KEPT || !run.results || Boolean(run.error))}
        ${button("Spec …", () => setDialog({ kind: "text" }))}${button("Save spec …", () => setDialog({ kind: "save" }))}
        ${button("Copy Python", python)}
        <button type="button" class="main" onClick=${() => setDialog({ kind: "report" })}>Write report …</button>
        ${button("Close", close)}
      </nav>`}
    </header>
    ${message && html`<p class="message" role="status"><span><${Words} text=${message} /></span> <button type="button" onClick=${() => setMessage(null)} aria-label="Dismiss">×</button></p>`}
    <input ref=${chooser} type="file" hidden onChange=${event => { dropped([...event.target.files]); event.target.value = ""; }} />
    ${!spec
      ? html`<${Start} key=${refreshed} vocabulary=${vocabulary} begin=${guarded(begin)} open=${guarded(openSpec)} fail=${fail} chooseFile=${() => chooser.current.click()}
          example=${guarded(async () => openSpec((await post("/api/example", {})).path))} />`
      : html`<div class="work">
        <div class="side">${isCompare ? controls : html`<p>This spec has no [compare]: its keys are changed under “Spec …”.</p>`}</div>
        <main tabindex="-1">
          ${open.length > 0
            ? html`<${Waits} waits=${waits} vocabulary=${vocabulary} />`
            : html`<${Status} run=${run} cancel=${() => computation.current.cancel()} again=${() => computation.current.start()} />`}
          <p class="heard" role="status">${heard}</p>
          ${unfit.map(name => html`<p class="blocked">No verdict may rest on surface ${name}: it fails a check. <button type="button" onClick=${() => document.getElementById(`checks-${name}`)?.scrollIntoView()}>Checks and remedies</button></p>`)}
          ${results}
          ${kept.length > 0 && !open.length && html`<${Kept} kept=${kept} fail=${fail} />`}
          ${!open.length && isCompare && html`<div class="surfaces">${Object.keys(spec.surface ?? {}).map(name => html`<${Surface} key=${name} name=${name} spec=${spec} folder=${folder} ready=${isReady} inputs=${inputs} fail=${fail} isCancelled=${run.isCancelled}
            onView=${(of, map) => setMaps(before => ({ ...before, [of]: map }))} />`)}</div>`}
          ${details}
        </main>
      </div>`}
    ${dialog?.kind === "text" && html`<${SpecText} close=${() => setDialog(null)} fail=${fail} />`}
    ${(dialog?.kind === "save" || dialog?.kind === "report") && html`<${Save} isReport=${dialog.kind === "report"} vocabulary=${vocabulary} close=${() => setDialog(null)} refresh=${() => setRefreshed(Date.now())} />`}
    ${dialog?.kind === "dropped" && html`<${Dialog} title="Another surface" close=${() => setDialog(null)}>
      <p><code>${dialog.path}</code> is kept.</p><p class="buttons">
        <button type="button" class="main" onClick=${() => { setDialog(null); guarded(begin)(dialog.path); }}>Begin with it</button>
        <button type="button" onClick=${() => { setDialog(null); guarded(beside)(dialog.path); }}>Put it beside</button></p>
    <//>`}
    <${Terms} terms=${vocabulary.terms} />
  </div>`;
};

// The card in words.
const spoken = ({ name, pieces }) => {
  const text = html => new DOMParser().parseFromString(html, "text/html").body.textContent;
  return `${name}. ${pieces.card.map(({ label, html: says }) => `${label}: ${text(says)}`).join(" ")}`;
};

// What a file does not hold, and its user must say.
const Waits = ({ waits, vocabulary }) => {
  const form = useRef(null);
  const { spec } = state();
  const [[name, kinds]] = Object.entries(spec.surface).slice(-1);
  const [[kind, of]] = Object.entries(kinds);
  const use = event => {
    event.preventDefault();
    const { pixel, ...given } = Object.fromEntries(new FormData(form.current));
    const pixels = pixel?.split(",").map(size => size.trim());
    const all = { ...given, ...(pixels && { pixel: pixels.length > 1 ? pixels : pixels[0] }) };
    const keys = Object.entries(all).reduce((next, [key, value]) => withValue(next, key.split("."), value), of);
    change({ spec: { ...spec, surface: { ...spec.surface, [name]: { [kind]: keys } } }, waits: [] });
  };
  const unit = (key, label) => waits.includes(key) && html`<label>${label} <select name=${key} required><option value="">choose …</option>
    ${lengthUnits(vocabulary).map(([one, text]) => html`<option value=${one}>${text}</option>`)}</select></label>`;
  return html`<section class="waits"><h2>What ${of.path ?? of.file} does not say</h2>
    <form ref=${form} onSubmit=${use}>
      ${waits.includes("pixel") && html`<label>Distance of neighbouring points <input name="pixel" type="text" required placeholder="0.8 um" autofocus /> <small>or 0.8 um, 0.5 um along x and y</small></label>`}
      ${unit("unit.xy", "Unit of x and y")}${unit("unit", "Unit of the heights")}${unit("unit.z", "Unit of the heights")}
      ${waits.includes("nominal-area") && html`<label>Nominal area of the asperities <input name="nominal-area" type="text" required placeholder="1 mm^2" autofocus /></label>`}
      <button class="main">Use</button>
    </form></section>`;
};

get("/api/vocabulary").then(
  vocabulary => render(html`<${App} vocabulary=${vocabulary} />`, document.getElementById("app")),
  error => { document.getElementById("app").textContent = error.message; },
);
