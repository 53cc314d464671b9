// The tree of an elimination: a column a round, a box a match, with who goes on.
//
//   page.append(bracket(data));   // data: what /api/tournaments/NAME answers

import { h } from './dom.js';

const sides = /** @type {const} */ ([['winners', 'Winners’ side'], ['losers', 'Losers’ side'], ['final', 'Final']]);

/**
 * Games won in the matches of a box, by name.
 * @param {any[]} matches
 * @param {string} agent
 */
const gamesWon = (matches, agent) => matches.flatMap((match) => match.games)
  .filter((game) => game.over && game.winner !== null && game.agents[game.winner] === agent).length;

/**
 * @param {any} place
 * @param {any[]} matches that were played for it
 */
function box(place, matches) {
  const games = matches.flatMap((match) => match.games);
  const live = games.find((game) => !game.over);
  const rows = place.agents.map((/** @type {string | null} */ agent) => {
    const state = !agent ? 'open' : place.winner === null ? '' : place.winner === agent ? 'through' : 'out';
    return h('span', { class: `side ${state}` },
      h('span', { class: 'name', title: agent ?? '' }, agent ?? (place.played ? '–' : 'bye')),
      agent && games.length > 0 && h('span', { class: 'points' }, gamesWon(matches, agent)));
  });
  const shown = live ?? games.at(-1);
  return shown ? h('a', { class: `box ${live ? 'running' : ''}`, href: `#/games/${shown.game}` }, rows)
    : h('div', { class: `box ${place.played ? '' : 'bye'}` }, rows);
}

/**
 * Rounds of one side, in order, each with its boxes.
 * @param {any[]} places
 */
function columns(places) {
  /** @type {Map<number, any[]>} */
  const rounds = new Map();
  for (const place of places) {
    rounds.set(place.round, [...(rounds.get(place.round) ?? []), place]);
  }
  return [...rounds].sort(([a], [b]) => a - b).filter(([, list]) => list.some((place) => place.played));
}

/**
 * The boxes of a round, each joined to where its winner goes: two to one, or one to one where losers of the
 * other side come in.
 * @param {any[]} places
 * @param {any[]} next of the round that follows, none after the last
 * @param {(place: any) => Node} boxOf
 */
function slots(places, next, boxOf) {
  const joined = next.length === 0 ? '' : next.length < places.length ? 'pairs' : 'straight';
  return h('div', { class: `boxes ${joined}` }, places.map((place) =>
    h('div', { class: `slot ${place.played ? '' : 'bye'}` }, boxOf(place))));
}

/** @param {any} data */
export function bracket(data) {
  const byId = new Map(data.matches.map((/** @type {any} */ match) => [match.match, match]));
  const matchesOf = (/** @type {any} */ place) => place.matches
    .map((/** @type {number} */ id) => byId.get(id)).filter(Boolean);
  const both = data.bracket.some((/** @type {any} */ place) => place.side !== 'winners');
  return sides.map(([side, title]) => {
    const rounds = columns(data.bracket.filter((/** @type {any} */ place) => place.side === side));
    return rounds.length > 0 && h('div', {}, both && h('h3', {}, title),
      h('div', { class: 'scroll' }, h('div', { class: 'bracket' }, rounds.map(([round, places], i) =>
        h('div', { class: 'round' }, h('span', { class: 'dim' }, `Round ${round}`),
          slots(places, rounds[i + 1]?.[1] ?? [], (place) => box(place, matchesOf(place))))))));
  });
}
