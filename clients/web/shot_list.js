// All turns of a game as links. A game may have hundreds: what is shown stays, what is new is added.
//
//   const list = new ShotList();
//   list.show(game); list.mark(17);

import { fill, h } from './dom.js';
import { turnWords } from './words.js';

export class ShotList {
  constructor() {
    this.element = h('ol', { class: 'shots' });
    /** @type {{turn: number, item: HTMLElement}[]} in the order of the turns */
    this.shown = [];
    /** @type {HTMLElement | undefined} */
    this.current = undefined;
  }

  /** @param {any} game */
  show(game) {
    const { turns } = game;
    if (turns[this.shown.length - 1]?.turn !== this.shown.at(-1)?.turn) {
      // After a gap turns lie between those that are shown.
      fill(this.element);
      this.shown = [];
    }
    for (const turn of turns.slice(this.shown.length)) {
      const item = this.item(game, turn);
      this.shown.push({ turn: turn.turn, item });
      this.element.append(item);
    }
  }

  /**
   * @param {any} game
   * @param {any} turn
   */
  item(game, turn) {
    const foul = (turn.ruling?.fouls ?? []).length > 0;
    const what = `${turnWords(turn)}${foul ? ' (foul)' : ''}`;
    return h('li', { class: foul ? 'foul' : '', 'data-turn': turn.turn },
      h('a', { href: `#/games/${game.game}/shots/${turn.turn}` },
        h('span', { class: 'n' }, turn.turn),
        h('span', { class: `seat seat${turn.by}` }, game.agents[turn.by]),
        h('span', { class: 'what', title: what }, what)));
  }

  /**
   * The turn that is on the table.
   * @param {number | undefined} turn
   */
  mark(turn) {
    const next = this.shown.find((each) => each.turn === turn)?.item;
    if (next !== this.current) {
      this.current?.classList.remove('current');
      this.current?.querySelector('a')?.removeAttribute('aria-current');
      next?.classList.add('current');
      next?.querySelector('a')?.setAttribute('aria-current', 'true');
      this.current = next;
    }
    this.scrollToCurrent();
  }

  /** Within the list alone: the page stays where it is. */
  scrollToCurrent() {
    const { current, element } = this;
    if (current) {
      const above = current.offsetTop - element.offsetTop;
      const hidden = above < element.scrollTop
        || above + current.offsetHeight > element.scrollTop + element.clientHeight;
      if (hidden) {
        element.scrollTop = above - element.clientHeight / 2;
      }
    }
  }
}
