// How much can be drawn in time: found out while the plant turns, as no page can ask the machine.

const WISHED = 40; // ms a frame while something moves
const PATIENCE = 1200; // ms
const LEAST = 60e3;
const MOST = 60e6;

export class Pace {
  /** Time from frame to frame while something moves, smoothed [ms]. */
  frameMs = 0;
  /** Triangles that are drawn while something moves. */
  budget: number;
  /** Share of the resolution while something moves. */
  scale = 1;
  private stillMs = 0;
  private last = -Infinity;
  private readonly software: boolean;

  constructor(software: boolean) {
    this.software = software;
    this.budget = software ? 400e3 : 6e6;
    if (software) this.scale = 0.6;
  }

  get slow(): boolean {
    return this.software || this.frameMs > 150;
  }

  /** Pictures that are averaged at rest: what a person waits a second for. */
  get samples(): number {
    const most = this.software ? 4 : 12;
    return this.stillMs ? Math.max(2, Math.min(most, Math.round(PATIENCE / this.stillMs))) : most;
  }

  /** What is smaller [px] is left out while something moves. */
  get leastPixels(): number {
    return this.scale < 1 ? 5 : 2;
  }

  frame(now: number, moving: boolean): void {
    const spent = now - this.last;
    this.last = now;
    if (spent <= 0 || spent > 5000) return;
    if (!moving) {
      this.stillMs = this.stillMs ? 0.5 * this.stillMs + 0.5 * spent : spent;
      return;
    }
    if (spent > 2000) return;
    this.frameMs = this.frameMs ? 0.7 * this.frameMs + 0.3 * spent : spent;
    if (this.frameMs > 1.3 * WISHED) this.slower();
    else if (this.frameMs < 0.7 * WISHED) this.faster();
  }

  private slower(): void {
    this.budget = Math.max(LEAST, this.budget * 0.85);
    if (this.budget < 300e3) this.scale = Math.max(0.4, this.scale - 0.1);
  }

  private faster(): void {
    if (this.scale < 1 && this.frameMs < 0.5 * WISHED) this.scale = Math.min(1, this.scale + 0.05);
    this.budget = Math.min(MOST, this.budget * 1.1);
  }
}
