// Shows the cards that match kind, surface and words.
"use strict";
{
  const form = document.querySelector(".filter");
  const cards = [...document.querySelectorAll(".cards li")];
  const [kind, surface, words] = ["kind", "surface", "words"].map(id => document.getElementById(id));
  const filter = () => {
    const wanted = words.value.toLowerCase().split(/\s+/);
    for (const card of cards) {
      const text = card.textContent.toLowerCase();
      card.hidden = !((!kind.value || card.dataset.kind === kind.value)
        && (!surface.value || card.dataset.surfaces.split("\n").includes(surface.value))
        && wanted.every(word => text.includes(word)));
    }
    for (const group of document.querySelectorAll("main > section")) group.hidden = !group.querySelector("li:not([hidden])");
    document.getElementById("count").textContent = `${cards.filter(card => !card.hidden).length} of ${cards.length}`;
  };
  form.addEventListener("input", filter);
  form.addEventListener("submit", event => event.preventDefault());
  form.hidden = false;
  filter();
}
