// The state of the page: one object. It is the spec, with where it lies, and the kept states; everything shown follows from it. It is
// in the address, so that a bookmark brings it back, and it can be undone.

const MOST_UNDONE = 200;
const EMPTY = { spec: null, folder: "", saved: null, waits: [], kept: [] };

const listeners = new Set();
let past = [];
let future = [];

const fromAddress = () => {
  try {
    return { ...EMPTY, ...JSON.parse(decodeURIComponent(location.hash.slice(1))) };
  } catch {
    return EMPTY;
  }
};

let current = fromAddress();
try {
  // A reload keeps what can be undone; another address does not.
  const kept = JSON.parse(sessionStorage.getItem("undo"));
  if (kept && kept.of === location.hash) ({ past, future } = kept);
} catch {
  // Without storage a reload forgets what could be undone.
}

const addressOf = state => (state.spec || state.kept.length ? `#${encodeURIComponent(JSON.stringify(state))}` : "#");

const show = isNewPage => {
  const address = addressOf(current);
  if (address !== location.hash) history[isNewPage ? "pushState" : "replaceState"](null, "", address);
  try {
    sessionStorage.setItem("undo", JSON.stringify({ of: location.hash, past: past.slice(-20), future: future.slice(-20) }));
  } catch {
    // It may be full.
  }
  listeners.forEach(listener => listener(current));
};

export const state = () => current;
export const listen = listener => {
  listeners.add(listener);
  return () => listeners.delete(listener);
};

// What was changed last, so that one movement of a slider is one step back.
let lastChange = { key: null, at: 0 };
const SAME_CHANGE = 800;

export const change = (patch, { key = null, isNewPage = false } = {}) => {
  const next = { ...current, ...patch };
  if (JSON.stringify(next) === JSON.stringify(current)) return;
  const now = performance.now();
  const isSame = key !== null && key === lastChange.key && now - lastChange.at < SAME_CHANGE;
  if (!isSame) past = [...past, current].slice(-MOST_UNDONE);
  lastChange = { key, at: now };
  future = [];
  current = next;
  show(isNewPage);
};

export const canUndo = () => past.length > 0;
export const canRedo = () => future.length > 0;
const step = (from, to) => {
  if (!from.length) return;
  to.push(current);
  current = from.pop();
  lastChange = { key: null, at: 0 };
  show(false);
};
export const undo = () => step(past, future);
export const redo = () => step(future, past);

addEventListener("popstate", () => {
  current = fromAddress();
  listeners.forEach(listener => listener(current));
});
addEventListener("hashchange", () => {
  if (addressOf(current) === location.hash) return;
  current = fromAddress();
  listeners.forEach(listener => listener(current));
});

// The value at a path of keys.
export const at = (spec, path) => path.reduce((value, key) => value?.[key], spec);

// The same spec with another value at a path; without the key, and without tables that only held it, where the value is undefined.
export const withValue = (spec, [key, ...rest], value) => {
  const next = { ...spec };
  if (rest.length) {
    const inside = withValue(typeof next[key] === "object" && next[key] !== null && !Array.isArray(next[key]) ? next[key] : {}, rest, value);
    if (Object.keys(inside).length) next[key] = inside;
    else delete next[key];
  } else if (value === undefined) {
    delete next[key];
  } else {
    next[key] = value;
  }
  return next;
};

export const setValue = (path, value) => change({ spec: withValue(current.spec, path, value) }, { key: path.join(".") });
