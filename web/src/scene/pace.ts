// How much can be drawn in time: found out while the plant turns, as no page can ask the machine.

const WISHED = 40; // ms a frame while something moves
const LEAST = 60e3;
const MOST = 60e6;

export class Pace {
  /** Time from frame to frame while something moves, smoothed [ms]. */
  frameMs = 0;
  /** Triangles that are drawn while something moves. */
  budget: number;
  /** Share of the resolution while something moves. */
  scale = 1;
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

  /** Pictures that are averaged at rest. */
  get samples(): number {
    return this.software ? 4 : 12;
  }

  /** What is smaller [px] is left out while something moves. */
  get leastPixels(): number {
    return this.scale < 1 ? 5 : 2;
  }

  frame(now: number, moving: boolean): void {
    const spent = now - this.last;
    this.last = now;
    if (!moving || spent > 2000 || spent <= 0) return;
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
