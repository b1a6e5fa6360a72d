// What the contact gives: cards, charts, contacts on the map, and the folded sections of the report.

import { html, useLayoutEffect, useRef, useState } from "./preact.js";
import { Words } from "./controls.js";
import { ChartOf, Html } from "./surface.js";

// A figure that is a picture, with a slider over its frames.
const Picture = ({ figure: { id, svg, data, caption } }) => {
  const place = useRef(null);
  useLayoutEffect(() => {
    place.current.innerHTML = svg;
    place.current.parentElement.querySelectorAll(".slider").forEach(slider => slider.remove());
    if (data?.frames?.names.length > 1) Chart.slider(place.current.parentElement, data.frames);
  }, [svg]);
  return html`<figure id=${id}><div class="picture" role="region" aria-label="Figure" tabindex="0" ref=${place}></div><figcaption dangerouslySetInnerHTML=${{ __html: caption }}></figcaption></figure>`;
};

const Figure = ({ figure }) => (figure.svg === null ? html`<${ChartOf} id=${figure.id} data=${figure.data} caption=${figure.caption} />` : html`<${Picture} figure=${figure} />`);

const Card = ({ lines, actions, isPreliminary }) => html`<dl class="card">
  ${lines.map(({ key, label, html: text, isOld }) => html`<div key=${key} class=${isOld ? "outdated" : ""}>
    <dt>${label}${isPreliminary && !isOld && " (preliminary)"}</dt><dd><span dangerouslySetInnerHTML=${{ __html: text }}></span>${actions[key]}</dd></div>`)}
</dl>`;

// Results after a stage beside those before: lines of the card that this stage does not have stay, as old ones.
export const merged = (before, stage, found) => {
  const isShort = stage === "models";
  const cases = found.cases.map((one, k) => {
    const old = before?.cases[k]?.pieces.card ?? [];
    const fresh = one.pieces.card;
    const has = key => fresh.some(line => line.key === key);
    if (!isShort || !old.length || before.cases.length !== found.cases.length) return one;
    const kept = old.map(line => fresh.find(other => other.key === line.key) ?? { ...line, isOld: true });
    const added = fresh.filter(line => !old.some(other => other.key === line.key));
    return { ...one, pieces: { ...one.pieces, card: [...added, ...kept].sort((a, b) => order(a.key) - order(b.key)) }, has };
  });
  const page = found.page ?? (before?.page ? { ...before.page, isOld: true } : null);
  return { ...found, cases, page, stage };
};
const ORDER = ["result", "conductance", "friction", "answer", "difference", "why", "instead", "nearer", "certainty"];
const order = key => (ORDER.indexOf(key) + ORDER.length + 1) % (ORDER.length + 1);

const STAGES = { models: "Intervals and causes follow", intervals: "Other treatments and boundary elements follow", everything: "Complete" };

const percent = ({ done, steps: [count, step] }) => `${Math.round(100 * done)} %${count > 1 ? `, ${Math.min(step + 1, count)} of ${count}` : ""}`;

// Where the computation is, with its end.
export const Status = ({ run, cancel, again }) => {
  if (run.error) return html`<p class="status wrong" role="alert"><span>${run.error.key && html`<code>${run.error.key}</code>: `}<${Words} text=${run.error.message} /></span></p>`;
  if (run.isCancelled) return html`<p class="status" role="status">Cancelled: what is greyed is out of date. <button type="button" onClick=${again}>Continue</button></p>`;
  if (!run.isRunning) return html`<p class="status" role="status">${run.results ? `Complete after ${(run.elapsed ?? 0).toFixed(1)} s` : ""}</p>`;
  const stage = run.stage ? STAGES[run.stage] : "Both models";
  return html`<p class="status"><span><span role="status">${stage}</span>${run.progress?.stage && `: ${run.progress.stage}, ${percent(run.progress)}`}</span>
    <progress max="1" value=${run.progress?.done ?? 0} aria-label="Progress"></progress><button type="button" onClick=${cancel}>Cancel</button></p>`;
};

// A thickness is compared with none: what is asked for stands first.
export const coatedFirst = cases => (cases.length === 2 && cases[0].thickness_m === 0 ? [cases[1], cases[0]] : cases);

// Those of the uncoated body beside the coated one are drawn once they are unfolded.
const Figures = ({ figures, isFolded }) => {
  const [isOpen, setOpen] = useState(!isFolded);
  const all = html`<div class="figures">${figures.map(figure => html`<${Figure} key=${figure.id} figure=${figure} />`)}</div>`;
  if (!isFolded) return all;
  return html`<details onToggle=${event => setOpen(event.target.open)}><summary>Curves and contacts</summary>${isOpen && all}</details>`;
};

// `actions` stand in the lines of the cards, by their keys.
export const Results = ({ run, actions }) => {
  const { results, isOutdated } = run;
  if (!results) return null;
  const several = results.cases.length > 1;
  const hasCards = results.cases.some(one => one.pieces.card.length);
  const page = results.page;
  return html`<div class=${`results${isOutdated ? " outdated" : ""}`} aria-busy=${isOutdated}>
    ${page?.lead && html`<div class=${page.isOld ? "outdated" : ""}><${Html} html=${page.lead} /></div>`}
    ${(hasCards ? coatedFirst(results.cases) : []).map((one, place) => html`<section key=${place} class="case">
      ${several && html`<h2>${one.name}${one.coated && html` <small>(on the ${one.coated})</small>`}</h2>`}
      <${Card} lines=${one.pieces.card} actions=${actions} isPreliminary=${results.stage === "models"} />
      ${actions.nearer && !one.pieces.card.some(line => line.key === "nearer") && html`<p>${actions.nearer}</p>`}
      <${Figures} figures=${one.pieces.figures} isFolded=${place > 0 && results.cases[0].thickness_m === 0} />
    </section>`)}
    ${page && page.card.length > 0 && !hasCards && html`<${Card} lines=${page.card} actions=${actions} />`}
    ${page && html`<div class=${`figures${page.isOld ? " outdated" : ""}`}>${page.figures.map(figure => html`<${Figure} key=${figure.id} figure=${figure} />`)}</div>`}
  </div>`;
};

// The folded sections of the report, and what it warns of.
export const Details = ({ run: { results, isOutdated } }) => {
  if (!results) return null;
  const { warnings, page } = results;
  return html`<div class=${isOutdated || page?.isOld ? "outdated" : ""}>
    ${warnings.length > 0 && !page?.sections && html`<details><summary>${warnings.length === 1 ? "1 warning" : `${warnings.length} warnings`}</summary><ul>${warnings.map(warning => html`<li><${Words} text=${warning} /></li>`)}</ul></details>`}
    ${page?.sections && html`<${Html} html=${page.sections} />`}
  </div>`;
};
