// All tournaments, and the games that go on.

import { getJson, throttled, watch } from './api.js';
import { fill, h, refill } from './dom.js';
import { dateText, spaced } from './words.js';

/**
 * A game that goes on, as a link.
 * @param {any} game
 */
export const liveGame = (game) => h('a', { class: 'live-game', href: `#/games/${game.game}` },
  h('span', { class: 'pulse', 'aria-hidden': 'true' }), `${game.agents[0]} – ${game.agents[1]}`,
  h('span', { class: 'dim' }, `game ${game.game}`));

/**
 * What no line ends in.
 * @param {string} text
 */
const together = (text) => h('span', { class: 'together' }, text);

/** @param {any} tournament */
export function progressBar({ games_over, games_planned, games_running }) {
  // A test may be decided while games go on.
  const beyond = games_planned ? Math.max(0, games_over - games_planned) : 0;
  const all = games_planned ? ` of ${games_planned}` : '';
  return h('div', { class: 'progress' },
    games_planned && h('progress', { max: games_planned, value: games_over, 'aria-label': 'Games played' }),
    h('span', {}, `${games_over - beyond}${all} games`, beyond > 0 ? `, ${beyond} too late to count` : '',
      games_running > 0 ? `, ${games_running} running` : ''));
}

export class TournamentsView {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
    this.abort = new AbortController();
    this.refresh = throttled(1000, () => this.load().catch(() => {}));
  }

  async open() {
    this.cards = h('div', { class: 'cards' });
    this.games = h('div', { class: 'live-games' });
    this.liveTitle = h('h2', {}, 'Live');
    fill(this.root, h('h1', {}, 'Tournaments'), this.cards, this.liveTitle, this.games);
    await this.load();
    this.live = watch('/ws/lobby', (message) => {
      this.paintLive(message.live.games);
      this.refresh();
    }, (state) => {
      this.root.dataset.live = state;
    });
  }

  close() {
    this.abort.abort();
    this.refresh.cancel();
    this.live?.close();
  }

  async load() {
    const { tournaments } = await getJson('/api/tournaments', this.abort.signal);
    refill(this.cards ?? this.root, tournaments.map((/** @type {any} */ t) => this.card(t)),
      tournaments.length === 0 && h('p', { class: 'dim' }, 'None yet.'));
  }

  /** @param {any} tournament */
  card(tournament) {
    const names = tournament.entries.map((/** @type {any} */ e) => e.agent);
    return h('a', { class: 'card', href: `#/tournaments/${encodeURIComponent(tournament.tournament)}` },
      h('div', { class: 'card-head' }, h('h2', {}, tournament.title || tournament.tournament),
        h('span', { class: `tag status-${tournament.status}` }, tournament.status)),
      h('p', { class: 'dim' }, [tournament.rules, tournament.format && spaced(tournament.format),
        `${names.length} entries`, dateText(tournament.created_ms)].filter(Boolean)
        .flatMap((text, i) => [i > 0 && ' · ', together(text)])),
      progressBar(tournament),
      h('p', { class: 'names' }, names.slice(0, 8).flatMap((/** @type {string} */ name, /** @type {number} */ i) => [i > 0 && ', ', together(name)]), names.length > 8 ? ', …' : ''));
  }

  /** @param {any[]} games */
  paintLive(games) {
    refill(this.games ?? this.root, games.slice(0, 60).map(liveGame),
      games.length === 0 && h('p', { class: 'dim' }, 'No game goes on.'));
  }
}
