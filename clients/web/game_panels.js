// Beside the table: who plays, with clock, score and balls to go; what was called and ruled.
//
//   const players = new PlayersPanel((seat) => millisecondsLeft(seat));
//   players.paint(game, state);
//   fill(ruling, ...turnPanel(game, turn));

import { colourOf } from './ball_art.js';
import { fill, h } from './dom.js';
import { ballsOf } from './scene.js';
import { callWords, capital, clockText, endingWords, rulingWords, turnWords } from './words.js';

/**
 * The ball that must be struck first in nine-ball.
 * @param {any} state
 */
const lowestOf = (state) => Math.min(...ballsOf(state).map((/** @type {any} */ b) => b.id).filter((/** @type {number} */ id) => id > 0));

/**
 * What a player has to do, or has done, in words.
 * @param {any} game
 * @param {any} state
 * @param {number} seat
 */
function standing(game, state, seat) {
  if (state.result) {
    return state.result.winner === seat ? 'won' : state.result.winner === null ? 'drawn' : 'lost';
  }
  const fouls = state.fouls_in_a_row?.[seat];
  const aim = state.groups?.[seat] ?? (game.rules === '8-ball' ? 'open table' : `on the ${lowestOf(state)}`);
  return fouls ? `${fouls} foul${fouls > 1 ? 's' : ''} in a row` : aim;
}

/**
 * @param {any} state
 * @param {number} seat
 */
function ballsLeft(state, seat) {
  const group = state.groups?.[seat];
  if (!group) {
    return [];
  }
  const own = (/** @type {number} */ id) => (group === 'solids' ? id > 0 && id < 8 : id > 8);
  return ballsOf(state).filter((/** @type {any} */ b) => own(b.id)).map((/** @type {any} */ b) => {
    const dot = h('span', { class: `dot ${b.id > 8 ? 'stripe' : ''}` }, b.id);
    dot.style.setProperty('--ball', colourOf(b.id));
    return dot;
  });
}

export class PlayersPanel {
  /** @param {(seat: number) => number} timeLeft ms on the clock of a seat, now */
  constructor(timeLeft) {
    this.timeLeft = timeLeft;
    this.players = [0, 1].map(() => h('div', { class: 'player' }));
    this.element = h('div', { class: 'players' }, this.players);
  }

  /**
   * @param {any} game
   * @param {any} state
   */
  paint(game, state) {
    this.players.forEach((element, seat) => {
      element.classList.toggle('to-move', state.to_move === seat && !state.result);
      element.classList.toggle('winner', state.result?.winner === seat);
      fill(element,
        h('div', { class: 'name' }, h('span', { class: `seat seat${seat}`, title: game.agents[seat] }, game.agents[seat])),
        h('div', { class: 'line' }, h('span', { class: 'clock' }, clockText(this.timeLeft(seat))),
          h('span', { class: 'score', title: 'games won in this match' }, game.match_score[seat])),
        h('div', { class: 'line' }, standing(game, state, seat)),
        h('div', { class: 'balls' }, ballsLeft(state, seat)));
    });
  }

  paintClocks() {
    this.players.forEach((element, seat) => {
      const clock = element.querySelector('.clock');
      if (clock) {
        clock.textContent = clockText(this.timeLeft(seat));
      }
    });
  }
}

/**
 * @param {any} game
 * @param {any} result
 */
function resultLine(game, result) {
  if (!result) {
    return null;
  }
  const who = result.winner === null ? 'Nobody wins' : `${game.agents[result.winner]} wins`;
  return h('p', { class: 'result' }, `${who}: ${endingWords(result.reason)}.`);
}

/** @param {any} turn */
function strokeTable({ intended, executed, moved }) {
  const rows = ['a', 'b', 'theta', 'phi', 'v'].map((key) => h('tr', {}, h('th', { scope: 'row' }, key),
    h('td', {}, intended[key].toFixed(3)), h('td', {}, executed[key].toFixed(3))));
  return h('details', {}, h('summary', {}, 'Stroke'),
    h('table', { class: 'numbers' }, h('tr', {}, h('td'), h('th', {}, 'intended'), h('th', {}, 'executed')), rows),
    moved && h('p', {}, 'Noise had made it impossible: the nearest possible shot was played.'));
}

/**
 * What was called in a turn, and what the referee made of it.
 * @param {any} game
 * @param {any} turn
 */
export function turnPanel(game, turn) {
  const call = turn.action !== 'shot' ? capital(turnWords(turn))
    : turn.state_before.kind === 'break' ? 'Break' : `Called: ${callWords(turn.call)}`;
  return [
    h('h2', {}, `Turn ${turn.turn}: ${game.agents[turn.by]}`),
    h('p', { class: 'call' }, call),
    h('ul', { class: 'clauses' }, rulingWords(turn.ruling).map(({ text, kind }) => h('li', { class: kind }, text))),
    resultLine(game, turn.state_after?.result),
    turn.action === 'shot' && strokeTable(turn),
  ];
}
