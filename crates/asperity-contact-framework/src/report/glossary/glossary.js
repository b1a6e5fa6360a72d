// Shows what a term means while it is pointed at, focused or after it was touched. Without it a click does.
"use strict";
for (const term of document.querySelectorAll(".term")) {
  const meaning = document.getElementById(term.getAttribute("popovertarget"));
  // A click would close what the pointer has opened.
  term.removeAttribute("popovertarget");
  let closing;
  const show = () => {
    clearTimeout(closing);
    if (!meaning.matches(":popover-open")) meaning.showPopover();
    const place = term.getBoundingClientRect();
    const left = Math.max(8, Math.min(place.left, innerWidth - meaning.offsetWidth - 8));
    const below = place.bottom + 4;
    const top = below + meaning.offsetHeight > innerHeight ? Math.max(8, place.top - meaning.offsetHeight - 4) : below;
    meaning.style.margin = 0;
    meaning.style.inset = `${top}px auto auto ${left}px`;
  };
  // Late enough for the pointer to reach the link.
  const hide = () => { closing = setTimeout(() => meaning.hidePopover(), 200); };
  for (const part of [term, meaning]) {
    part.addEventListener("pointerenter", show);
    part.addEventListener("pointerleave", hide);
    part.addEventListener("focusin", show);
    part.addEventListener("focusout", hide);
  }
  term.addEventListener("click", show);
}
