// Everything that a key or a button does, in one list: the help overlay shows it, the keyboard runs it.

export interface Command {
  id: string;
  /** As KeyboardEvent.key names it, with "Ctrl+" and "Shift+" before it; none for commands without a key. */
  key?: string;
  title: string;
  area: "View" | "Selection" | "Review" | "Network" | "Corrections" | "Help";
  /** Whether it can be run now; always where absent. */
  when?: () => boolean;
  run: () => void;
}

const commands = new Map<string, Command>();

export function addCommands(...added: Command[]): void {
  for (const command of added) commands.set(command.id, command);
}

export function allCommands(): Command[] {
  return [...commands.values()];
}

export function run(id: string): void {
  const command = commands.get(id);
  if (command && (command.when?.() ?? true)) command.run();
}

/** Whether a key that is pressed in a text field is none of the field's own. */
function meantForPage(pressed: KeyboardEvent): boolean {
  return pressed.key === "Escape" || (pressed.ctrlKey && !/^[acvxyz]$/i.test(pressed.key));
}

/** Runs the command of a key, unless somebody is typing text. */
export function listenToKeys(target: HTMLElement | Document): void {
  target.addEventListener("keydown", (event) => {
    const pressed = event as KeyboardEvent;
    const on = pressed.target as HTMLElement | null;
    const typing = !!on && (on.isContentEditable || /^(INPUT|TEXTAREA|SELECT)$/.test(on.tagName));
    if (pressed.defaultPrevented || pressed.altKey || (typing && !meantForPage(pressed))) return;
    // A letter by the Shift key alone: with Caps Lock its case says nothing.
    const letter = /^[a-z]$/i.test(pressed.key);
    const named = letter ? (pressed.shiftKey ? pressed.key.toUpperCase() : pressed.key.toLowerCase()) : pressed.key;
    const shift = pressed.shiftKey && named.length > 1 ? "Shift+" : "";
    const key = `${pressed.ctrlKey || pressed.metaKey ? "Ctrl+" : ""}${shift}${named}`;
    for (const command of commands.values()) {
      if (command.key === key && (command.when?.() ?? true)) {
        pressed.preventDefault();
        command.run();
        return;
      }
    }
  });
}
