// Draws the curves of the cases that are chosen, which the address keeps.
"use strict";
{
  const cases = JSON.parse(document.getElementById("cases").textContent);
  const boxes = [...document.querySelectorAll(".cases input")];
  const figure = document.getElementById("comparison");
  const form = document.querySelector(".filter");
  const [along, words, count] = ["along", "words", "count"].map(id => document.getElementById(id));
  const address = one => `${one.report}/${one.name}`;

  // The quotient of both models at the pressures of the deterministic one, from straight lines on logarithmic axes.
  const difference = ({ statistical, deterministic }, x) => {
    const line = statistical[x].map((place, k) => [Math.log(place), Math.log(statistical[2][k])]).sort((a, b) => a[0] - b[0]);
    return deterministic[x].map((place, k) => {
      const at = Math.log(place);
      const next = line.findIndex(([x]) => x >= at);
      if (next < 0 || (next === 0 && line[0][0] > at)) return null;
      const [x1, y1] = line[next];
      const [x0, y0] = line[Math.max(0, next - 1)];
      const y = x1 > x0 ? y0 + ((y1 - y0) * (at - x0)) / (x1 - x0) : y1;
      return 100 * (Math.exp(y) / deterministic[2][k] - 1);
    });
  };

  const draw = () => {
    const chosen = boxes.filter(box => box.checked).map(box => cases[Number(box.value)]);
    boxes.forEach(box => { box.disabled = !box.checked && chosen.length >= COLOURS.length; });
    const x = Number(along.value);
    const axis = (label, log) => ({ log, units: [{ label, factor: 1 }] });
    const panel = (title, y, curves) => {
      const made = { title, height: 300, x: axis(along.selectedOptions[0].textContent, true), y, places: [], series: [], marks: [] };
      chosen.forEach((one, k) => {
        for (const [dash, places, values] of curves(one)) {
          made.places.push(places);
          const name = `${one.report}: ${one.name}`;
          made.series.push({ name, kind: "line", colour: COLOURS[k], dash, width: 1, opacity: 1, x: made.places.length - 1, y: values });
        }
      });
      return made;
    };
    const both = column => ({ models: { deterministic, statistical } }) => [
      ["solid", deterministic[x], deterministic[column]],
      ["dashed", statistical[x], statistical[column]],
    ];
    const panels = [
      panel("Real contact area", axis("area ratio A/A_nom", true), both(2)),
      panel("Separation", axis("separation d/σ", false), both(3)),
      panel("Statistical minus deterministic", axis("difference of area (%)", false),
        ({ models }) => [["solid", models.deterministic[x], difference(models, x)]]),
    ];
    figure.querySelector(".chart")?.remove();
    if (chosen.length) new Chart(figure, { panels });
    count.textContent = `${chosen.length} chosen, at most ${COLOURS.length}`;
    history.replaceState(null, "", `#${chosen.map(one => encodeURIComponent(address(one))).join("&")}`);
  };

  const wanted = location.hash.slice(1).split("&").map(decodeURIComponent);
  boxes.forEach(box => { box.checked = wanted.includes(address(cases[Number(box.value)])); });
  if (!boxes.some(box => box.checked)) {
    const reports = [...new Set(cases.map(one => one.report))].slice(0, 3);
    reports.forEach(report => { boxes[cases.findIndex(one => one.report === report)].checked = true; });
  }
  boxes.forEach(box => { box.disabled = false; box.addEventListener("change", draw); });
  along.addEventListener("change", draw);
  words.addEventListener("input", () => {
    const parts = words.value.toLowerCase().split(/\s+/);
    for (const box of boxes) {
      const row = box.closest("tr");
      row.hidden = !parts.every(part => row.textContent.toLowerCase().includes(part));
    }
  });
  form.addEventListener("submit", event => event.preventDefault());
  form.hidden = false;
  draw();
}
