// Presses on what lies over the view.

/** What is pressed in an element is not pressed on what lies below it. */
export function keepPresses(element: HTMLElement): void {
  for (const name of ["pointerdown", "click", "dblclick"]) element.addEventListener(name, (event) => event.stopPropagation());
  // A drag that began elsewhere goes on over it.
  element.addEventListener("pointermove", (event) => {
    if (!event.buttons) event.stopPropagation();
  });
}
