// Play, pause, step, speed, and a scrubber with a mark for every event.
//
//   const bar = new TransportBar(playback, { onShot: (by) => go(by) });
//   page.append(bar.element);
//   bar.show(events); bar.update();

import { button, fill, h, icon, svg } from './dom.js';
import { speeds } from './playback.js';
import { eventWords } from './words.js';

/** @typedef {import('./playback.js').Playback} Playback */

export class TransportBar {
  /**
   * @param {Playback} playback
   * @param {{onShot?: (by: 1 | -1) => void}} options
   */
  constructor(playback, { onShot } = {}) {
    this.playback = playback;
    this.shownPlaying = false;
    this.playButton = button('Play or pause (space)', icon('play'), () => playback.toggle());
    this.playButton.classList.add('primary');
    this.speed = /** @type {HTMLSelectElement} */ (h('select', { 'aria-label': 'Speed' },
      speeds.map((s) => h('option', { value: s }, `${s}×`))));
    this.speed.value = '1';
    this.speed.onchange = () => {
      playback.speed = Number(this.speed.value);
    };
    this.range = /** @type {HTMLInputElement} */ (h('input', {
      type: 'range', min: 0, max: 1, step: 'any', 'aria-label': 'Time of the shot',
    }));
    this.range.oninput = () => {
      playback.pause();
      playback.seek(Number(this.range.value));
    };
    this.marks = svg('svg', { class: 'marks', 'aria-hidden': 'true', preserveAspectRatio: 'none' });
    this.time = h('output', { class: 'time' });
    this.event = h('span', { class: 'event', 'aria-live': 'off' });
    this.element = h('div', { class: 'transport' },
      h('div', { class: 'scrub' }, this.marks, this.range),
      h('div', { class: 'buttons' },
        onShot && button('Previous shot (shift+left)', icon('first'), () => onShot(-1)),
        button('Event before (left)', icon('before'), () => playback.step(-1)),
        this.playButton,
        button('Next event (right)', icon('after'), () => playback.step(1)),
        onShot && button('Next shot (shift+right)', icon('last'), () => onShot(1)),
        this.speed, this.time, this.event));
    /** @type {any[]} */
    this.events = [];
  }

  /** @param {any[]} events */
  show(events) {
    const { start, end } = this.playback;
    const span = Math.max(1e-9, end - start);
    this.events = events;
    this.range.min = String(start);
    this.range.max = String(end);
    this.marks.setAttribute('viewBox', '0 0 1000 10');
    fill(this.marks, events.map((event) => {
      const x = ((event.t - start) / span) * 1000;
      const tall = event.type !== 'transition';
      return svg('rect', {
        x: x - 1, y: tall ? 0 : 5, width: 2, height: tall ? 10 : 5, class: `mark ${event.type}`,
      });
    }));
    this.update();
  }

  update() {
    const { t, playing, speed } = this.playback;
    this.range.value = String(t);
    if (this.shownPlaying !== playing) {
      this.shownPlaying = playing;
      fill(this.playButton, icon(playing ? 'pause' : 'play'));
    }
    this.speed.value = String(speed);
    this.time.textContent = `${Math.max(0, t).toFixed(2)} s`;
    const last = this.events.filter((event) => event.t <= t + 1e-9).at(-1);
    this.event.textContent = last ? eventWords(last) : '';
    this.range.setAttribute('aria-valuetext', `${t.toFixed(2)} seconds`);
  }

  /**
   * The keys that work wherever the focus is, but for fields.
   * @param {KeyboardEvent} event
   */
  key(event) {
    const { playback } = this;
    switch (event.key) {
      case ' ': playback.toggle(); break;
      case 'ArrowRight': playback.step(1); break;
      case 'ArrowLeft': playback.step(-1); break;
      case 'Home': playback.seek(playback.start); break;
      case 'End': playback.seek(playback.end); break;
      case '+': case ']': playback.changeSpeed(1); break;
      case '-': case '[': playback.changeSpeed(-1); break;
      default: return false;
    }
    return true;
  }
}
