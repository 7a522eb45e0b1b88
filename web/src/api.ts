// Where the page gets its data from: the server that it was opened by, or the file that it is.

import type {
  AuditRow,
  Content,
  Edit,
  Isolated,
  Manifest,
  Question,
  ServerState,
  Traced,
  Update,
} from "./types.ts";

/** What the server refused, in one line for the person. */
export class Refused extends Error {
  readonly status: number;
  /** The state that the server is in, where another window was quicker. */
  readonly state: ServerState | null;

  constructor(message: string, status: number, state: ServerState | null = null) {
    super(message);
    this.name = "Refused";
    this.status = status;
    this.state = state;
  }
}

export interface Source {
  /** Whether there is a server that answers and takes corrections. */
  readonly live: boolean;
  state(): Promise<ServerState>;
  /** Calls back on every change of the server's state until the signal says stop; comes back by itself after a break. */
  follow(signal: AbortSignal, changed: (state: ServerState) => void, lost: (reason: string) => void): Promise<void>;
  content(): Promise<Content>;
  manifest(): Promise<Manifest>;
  file(name: string, signal?: AbortSignal): Promise<ArrayBuffer>;
  schematic(): Promise<string>;
  explain(kind: "part" | "unit", id: string): Promise<string[]>;
  trace(at: string, direction: "upstream" | "downstream", to?: string): Promise<Traced>;
  isolate(at: string): Promise<Isolated>;
  review(limit?: number): Promise<Question[]>;
  audit(): Promise<AuditRow[]>;
  edit(version: number, edits: Edit[], why?: string): Promise<Update>;
  undo(version: number): Promise<Update>;
  redo(version: number): Promise<Update>;
  answer(version: number, question: string, option: number | "skip" | "unsure", why?: string): Promise<Update>;
}

const DATA = "cadgraph-data-";

/** The source of this page's data. */
export function openSource(): Source {
  return document.getElementById(`${DATA}content`) ? new FileSource() : new ServerSource(takeToken());
}

function takeToken(): string {
  const token = new URLSearchParams(location.search).get("token");
  return token ?? "";
}

class ServerSource implements Source {
  readonly live = true;
  private readonly headers: Record<string, string>;

  constructor(token: string) {
    this.headers = { Authorization: `Bearer ${token}` };
  }

  state = () => this.json<ServerState>("api/state");
  content = () => this.json<Content>("api/content");
  manifest = () => this.json<Manifest>("api/scene");
  review = (limit = 50) => this.json<Question[]>(`api/review?limit=${limit}`);
  audit = () => this.json<AuditRow[]>("api/audit");

  async file(name: string, signal?: AbortSignal): Promise<ArrayBuffer> {
    return (await this.call(`api/scene/${encodeURIComponent(name)}`, { signal })).arrayBuffer();
  }

  async schematic(): Promise<string> {
    return (await this.call("api/schematic")).text();
  }

  async explain(kind: "part" | "unit", id: string): Promise<string[]> {
    return (await this.json<{ lines: string[] }>(`api/${kind}/${encodeURIComponent(id)}`)).lines;
  }

  trace(at: string, direction: "upstream" | "downstream", to?: string): Promise<Traced> {
    const query = new URLSearchParams({ at, direction, ...(to ? { to } : {}) });
    return this.json(`api/trace?${query}`);
  }

  isolate(at: string): Promise<Isolated> {
    return this.json(`api/isolate?${new URLSearchParams({ at })}`);
  }

  edit = (version: number, edits: Edit[], why = "") => this.post<Update>("api/edit", { version, edits, why });
  undo = (version: number) => this.post<Update>("api/undo", { version });
  redo = (version: number) => this.post<Update>("api/redo", { version });
  answer = (version: number, question: string, option: number | "skip" | "unsure", why = "") =>
    this.post<Update>("api/answer", { version, question, option, why });

  async follow(
    signal: AbortSignal,
    changed: (state: ServerState) => void,
    lost: (reason: string) => void,
  ): Promise<void> {
    let wait = 500;
    while (!signal.aborted) {
      try {
        const answer = await this.call("api/events", { signal });
        const reader = answer.body!.pipeThrough(new TextDecoderStream()).getReader();
        let text = "";
        for (;;) {
          const { done, value } = await reader.read();
          if (done) break;
          wait = 500;
          text += value;
          let end: number;
          while ((end = text.indexOf("\n\n")) >= 0) {
            const data = text
              .slice(0, end)
              .split("\n")
              .filter((line) => line.startsWith("data:"))
              .map((line) => line.slice(5).trim())
              .join("\n");
            text = text.slice(end + 2);
            if (data) changed(JSON.parse(data) as ServerState);
          }
        }
      } catch (error) {
        if (signal.aborted) return;
        if (error instanceof Refused && error.status === 403) {
          lost(error.message);
          return;
        }
      }
      if (signal.aborted) return;
      lost("The server does not answer. Corrections that were confirmed are kept; start 'cadgraph view' again.");
      await new Promise((resolve) => setTimeout(resolve, wait));
      wait = Math.min(2 * wait, 5000);
    }
  }

  private async json<T>(path: string): Promise<T> {
    return (await this.call(path)).json() as Promise<T>;
  }

  private async post<T>(path: string, body: unknown): Promise<T> {
    const headers = { ...this.headers, "Content-Type": "application/json" };
    return (await this.call(path, { method: "POST", body: JSON.stringify(body), headers })).json() as Promise<T>;
  }

  private async call(path: string, init: RequestInit = {}): Promise<Response> {
    let answer: Response;
    try {
      answer = await fetch(path, { headers: this.headers, ...init });
    } catch (error) {
      if (error instanceof DOMException && error.name === "AbortError") throw error;
      throw new Refused("The server does not answer; start 'cadgraph view' again. Nothing confirmed is lost.", 0);
    }
    if (!answer.ok) {
      const said = (await answer.json().catch(() => ({}))) as { error?: string; state?: ServerState };
      throw new Refused(said.error ?? `The server answered with ${answer.status}.`, answer.status, said.state ?? null);
    }
    return answer;
  }
}

const VIEW_ONLY = "This file is for looking only; corrections are made with 'cadgraph view'.";

class FileSource implements Source {
  readonly live = false;

  async state(): Promise<ServerState> {
    const content = await this.content();
    return {
      status: "ready", stage: "", share: 1, message: "", version: content.version, read_only: VIEW_ONLY,
      title: content.title, folder: "", can_undo: false, can_redo: false, undo: null, redo: null, n_edits: 0,
      lost: [], who: "",
    };
  }

  follow = () => Promise.resolve();
  content = async () => JSON.parse(await this.text("content")) as Content;
  manifest = async () => JSON.parse(await this.text("manifest")) as Manifest;
  file = (name: string) => this.bytes(name);
  schematic = () => this.text("schematic");
  explain = () => Promise.resolve([]);
  review = () => Promise.resolve([]);
  audit = () => Promise.resolve([]);
  trace = () => this.refuse();
  isolate = () => this.refuse();
  edit = () => this.refuse();
  undo = () => this.refuse();
  redo = () => this.refuse();
  answer = () => this.refuse();

  private refuse(): Promise<never> {
    return Promise.reject(new Refused(VIEW_ONLY, 403));
  }

  private async text(name: string): Promise<string> {
    return new TextDecoder().decode(await this.bytes(name));
  }

  private async bytes(name: string): Promise<ArrayBuffer> {
    const element = document.getElementById(DATA + name);
    if (!element) throw new Refused(`This file lacks ${name}; export it again.`, 404);
    const packed = Uint8Array.from(atob((element.textContent ?? "").trim()), (c) => c.charCodeAt(0));
    const opened = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Response(opened).arrayBuffer();
  }
}
