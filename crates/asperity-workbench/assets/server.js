// Requests to the server.

const refused = async response => {
  const text = await response.text();
  try {
    return JSON.parse(text);
  } catch {
    return { key: null, message: text || `the server answered ${response.status}` };
  }
};

const GONE = { key: null, message: "The workbench does not answer. Start it again with `experiment serve`; this page then goes on." };

const send = async (path, options) => {
  let response;
  try {
    response = await fetch(path, options);
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw GONE;
  }
  if (!response.ok) throw await refused(response);
  return response;
};

const posted = (body, signal) => ({ method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body), signal });

export const get = async path => (await send(path, {})).json();
export const post = async (path, body) => (await send(path, posted(body))).json();
export const bytes = async (path, body, signal) => (await send(path, posted(body, signal))).arrayBuffer();
export const upload = async file => (await send(`/api/upload/${encodeURIComponent(file.name)}`, { method: "POST", body: file })).json();

// Server-sent events of a request with a body, which EventSource cannot send: `hear(name, value)` for each. Throws what the event
// `error` holds.
export const events = async (path, body, signal, hear) => {
  const response = await send(path, posted(body, signal));
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  let isDone = false;
  const event = block => {
    let name = "message";
    const data = [];
    for (const line of block.split("\n")) {
      if (line.startsWith("event:")) name = line.slice(6).trim();
      else if (line.startsWith("data:")) data.push(line.slice(5).replace(/^ /, ""));
    }
    if (!data.length) return;
    const value = JSON.parse(data.join("\n"));
    if (name === "error") throw value;
    if (name === "done") isDone = true;
    else hear(name, value);
  };
  try {
    for (;;) {
      const { value, done } = await reader.read();
      if (done) break;
      const blocks = (rest + value).split("\n\n");
      rest = blocks.pop();
      blocks.forEach(event);
    }
  } catch (error) {
    if (error instanceof TypeError) throw GONE;
    throw error;
  }
  if (!isDone && !signal?.aborted) throw GONE;
};
