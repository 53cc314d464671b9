// Time of a shot on the screen: plays, pauses, jumps from event to event. Knows no drawing.
//
//   const playback = new Playback(() => redraw());
//   playback.load(motion.duration, events, -0.7);
//   playback.play();

/** Before the strike, s: the cue is drawn back. */
export const leadTime = 0.7;
export const speeds = [0.1, 0.25, 0.5, 1, 2, 4, 10];

export class Playback {
  /**
   * @param {() => void} onFrame
   * @param {() => void} [onEnd]
   */
  constructor(onFrame, onEnd = () => {}) {
    this.onFrame = onFrame;
    this.onEnd = onEnd;
    this.t = 0;
    this.start = 0;
    this.end = 0;
    this.speed = 1;
    this.playing = false;
    /** @type {number[]} */
    this.stops = [];
    this.last = 0;
    this.handle = 0;
  }

  /**
   * @param {number} duration
   * @param {{t: number}[]} events
   * @param {number} at
   */
  load(duration, events, at) {
    this.pause();
    this.start = events.length > 0 ? -leadTime : 0;
    this.end = duration;
    this.stops = [...new Set([this.start, ...events.map((e) => e.t), duration])];
    this.seek(at);
  }

  /** @param {number} t */
  seek(t) {
    this.t = Math.min(this.end, Math.max(this.start, t));
    this.onFrame();
  }

  play() {
    if (this.playing) {
      return;
    }
    if (this.t >= this.end) {
      this.t = this.start;
    }
    this.playing = true;
    this.last = performance.now();
    this.handle = requestAnimationFrame((now) => this.tick(now));
    this.onFrame();
  }

  pause() {
    const was = this.playing;
    this.playing = false;
    cancelAnimationFrame(this.handle);
    if (was) {
      this.onFrame();
    }
  }

  toggle() {
    if (this.playing) {
      this.pause();
    } else {
      this.play();
    }
  }

  /** @param {number} now */
  tick(now) {
    if (!this.playing) {
      return;
    }
    this.t = Math.min(this.end, this.t + (Math.max(0, now - this.last) / 1000) * this.speed);
    this.last = now;
    this.playing = this.t < this.end;
    this.onFrame();
    if (this.playing) {
      this.handle = requestAnimationFrame((next) => this.tick(next));
    } else {
      this.onEnd();
    }
  }

  /**
   * To the next event, or back to the one before.
   * @param {1 | -1} direction
   */
  step(direction) {
    this.pause();
    const beyond = direction > 0 ? this.stops.find((s) => s > this.t + 1e-9)
      : [...this.stops].reverse().find((s) => s < this.t - 1e-9);
    if (beyond !== undefined) {
      this.seek(beyond);
    }
  }

  /** @param {1 | -1} direction */
  changeSpeed(direction) {
    const at = speeds.indexOf(this.speed) + direction;
    this.speed = speeds[Math.min(speeds.length - 1, Math.max(0, at))];
    this.onFrame();
  }

  stop() {
    this.playing = false;
    cancelAnimationFrame(this.handle);
  }
}
