// A tournament: progress, standings with error bars, crosstable, games; live while it goes on.

import { getJson, throttled, watch } from './api.js';
import { bracket } from './bracket_view.js';
import { intervalChart, testGauge } from './charts.js';
import { h, refill } from './dom.js';
import { progressBar } from './tournaments_view.js';
import { capital, endingWords, resultWords, signed, spaced } from './words.js';

const mostGames = 300;
const mostCharted = 40;
/** Rows; tables with more scroll by themselves. */
const longTable = 30;
/** Entries; from here a crosstable's cells are small. */
const crowded = 14;

/**
 * What a table is in: wide ones scroll sideways, long ones too.
 * @param {number} rows
 * @param {HTMLElement} table
 */
const inScroll = (rows, table) => h('div', { class: rows > longTable ? 'scroll long' : 'scroll' }, table);

/** @param {any} row */
function ratingText(row) {
  if (row.estimate) {
    return `${signed(row.estimate.elo)} ± ${row.estimate.margin.toFixed(0)}`;
  }
  return row.rating === 'no_games' ? '' : spaced(row.rating);
}

/** @param {any} data */
function termsText(data) {
  const round = data.rounds_drawn && data.format !== 'sprt' && `round ${data.rounds_drawn}${data.rounds ? ` of ${data.rounds}` : ''}`;
  return [data.rules, data.format && (data.format === 'sprt' ? 'SPRT' : spaced(data.format)), round,
    data.games_per_match && `matches of ${data.games_per_match}`, data.table && `table ${data.table}`]
    .filter(Boolean).join(' · ');
}

/** @param {string} name */
const agentLink = (name) => h('a', { href: `#/agents/${encodeURIComponent(name)}`, title: name }, name);

export class TournamentView {
  /**
   * @param {HTMLElement} root
   * @param {string} id
   */
  constructor(root, id) {
    this.root = root;
    this.id = id;
    this.abort = new AbortController();
    this.last = '';
    this.refresh = throttled(1000, () => this.load().catch(() => {}));
  }

  async open() {
    await this.load();
    this.live = watch('/ws/lobby', () => this.refresh(), (state) => {
      this.root.dataset.live = state;
    });
  }

  close() {
    this.abort.abort();
    this.refresh.cancel();
    this.live?.close();
  }

  async load() {
    const data = await getJson(`/api/tournaments/${encodeURIComponent(this.id)}`, this.abort.signal);
    const text = JSON.stringify(data);
    if (text !== this.last) {
      this.last = text;
      this.paint(data);
    }
  }

  /** @param {any} data */
  paint(data) {
    refill(this.root,
      h('nav', { class: 'crumbs' }, h('a', { href: '#/' }, 'Tournaments'),
        h('span', { 'aria-current': 'page' }, data.title || data.tournament),
        h('span', { class: `tag status-${data.status}` }, data.status)),
      h('div', { class: 'card wide' },
        h('p', { class: 'dim' }, termsText(data)),
        progressBar(data),
        data.sprt && testGauge(data.sprt),
        data.remarks.map((/** @type {string} */ line) => h('p', { class: 'remark' }, line))),
      data.bracket.length > 0 && h('section', {}, h('h2', {}, 'Bracket'), bracket(data)),
      h('div', { class: 'columns' },
        h('section', {}, h('h2', {}, 'Standings'), this.standings(data)),
        h('section', {}, h('h2', {}, 'Elo with 95 % intervals'), this.chart(data))),
      h('div', { class: data.standings.length > crowded ? '' : 'columns' },
        h('section', {}, h('h2', {}, 'Who against whom'), this.crosstable(data)),
        h('section', {}, h('h2', {}, 'How games ended'), this.endings(data))),
      h('section', {}, h('h2', {}, 'Games'), this.games(data)));
  }

  /** @param {any} data */
  standings(data) {
    const head = ['', 'Agent', 'Points', 'Games', 'Won', 'Lost', 'Drawn', 'Elo'];
    return inScroll(data.standings.length, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, head.map((text, i) => h('th', { scope: 'col', class: i > 1 ? 'num' : '' }, text)))),
      h('tbody', {}, data.standings.map((/** @type {any} */ row) => h('tr', {},
        h('td', { class: 'num' }, row.rank), h('th', { scope: 'row' }, agentLink(row.agent)),
        [row.points, row.games, row.wins, row.losses, row.draws, ratingText(row)]
          .map((value) => h('td', { class: 'num' }, value)))))));
  }

  /** @param {any} data */
  chart(data) {
    const rated = data.standings.filter((/** @type {any} */ row) => row.estimate);
    if (rated.length === 0) {
      return h('p', { class: 'dim' }, 'The games so far give no ratings that can be compared.');
    }
    const advantage = data.break_advantage;
    return h('div', {}, intervalChart(rated.slice(0, mostCharted).map((/** @type {any} */ row) =>
      ({ label: row.agent, value: row.estimate.elo, margin: row.estimate.margin })), 'Elo with 95 % intervals'),
    rated.length > mostCharted && h('p', { class: 'dim' }, `The first ${mostCharted} of ${rated.length}.`),
    advantage && h('p', { class: 'dim' },
      `The break is worth ${signed(advantage.elo)} ± ${advantage.margin.toFixed(0)} Elo.`));
  }

  /** @param {any} data */
  crosstable(data) {
    const { standings, crosstable } = data;
    const cell = (/** @type {number[] | null} */ value, /** @type {boolean} */ own) => {
      if (own || !value) {
        return h('td', { class: 'num dim' }, own ? '×' : '');
      }
      const td = h('td', { class: 'num heat' }, `${value[0]}/${value[1]}`);
      td.style.setProperty('--share', String(value[0] / value[1]));
      return td;
    };
    return inScroll(standings.length, h('table', { class: `data cross ${standings.length > crowded ? 'crowded' : ''}` },
      h('thead', {}, h('tr', {}, h('th'), h('th'),
        standings.map((/** @type {any} */ row, /** @type {number} */ i) =>
          h('th', { scope: 'col', title: row.agent }, i + 1)))),
      h('tbody', {}, standings.map((/** @type {any} */ row, /** @type {number} */ i) => h('tr', {},
        h('td', { class: 'num' }, i + 1), h('th', { scope: 'row', title: row.agent }, row.agent),
        crosstable[i].map((/** @type {any} */ value, /** @type {number} */ k) => cell(value, i === k)))))));
  }

  /** @param {any} data */
  endings(data) {
    const list = Object.entries(data.endings).map(([reason, count]) => ({ reason, count: Number(count) }))
      .sort((a, b) => b.count - a.count);
    const most = Math.max(1, ...list.map(({ count }) => count));
    if (list.length === 0) {
      return h('p', { class: 'dim' }, 'No game is over yet.');
    }
    return h('table', { class: 'data endings' }, h('tbody', {}, list.map(({ reason, count }) => {
      const bar = h('span', { class: 'bar' });
      bar.style.setProperty('--share', String(count / most));
      return h('tr', {}, h('th', { scope: 'row' }, capital(endingWords(reason))), h('td', { class: 'num' }, count),
        h('td', { class: 'wide' }, bar));
    })));
  }

  /** @param {any} data */
  games(data) {
    const byRounds = data.format !== 'round_robin' && data.matches.some((/** @type {any} */ match) => match.round);
    const rows = data.matches.flatMap((/** @type {any} */ match) =>
      match.games.map((/** @type {any} */ game) => ({ ...game, round: match.round })))
      .sort((/** @type {any} */ a, /** @type {any} */ b) => Number(a.over) - Number(b.over) || b.game - a.game);
    const result = (/** @type {any} */ game) => {
      if (!game.over) {
        return h('span', { class: 'tag status-running' }, 'running');
      }
      return resultWords(game);
    };
    return h('div', {}, inScroll(rows.length, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, ['Game', byRounds && 'Round', 'Breaks first', 'Against', 'Result', 'Turns'].filter(Boolean)
        .map((text) => h('th', { scope: 'col', class: /Game|Round|Turns/.test(String(text)) ? 'num' : '' }, text)))),
      h('tbody', {}, rows.slice(0, mostGames).map((/** @type {any} */ game) => h('tr', {},
        h('td', { class: 'num' }, h('a', { href: `#/games/${game.game}` }, game.game)),
        byRounds && h('td', { class: 'num dim' }, game.round ?? ''),
        h('td', {}, game.agents[0]), h('td', {}, game.agents[1]), h('td', {}, result(game)),
        h('td', { class: 'num' }, game.turns ?? '')))))),
    rows.length > mostGames && h('p', { class: 'dim' }, `The newest ${mostGames} of ${rows.length}.`));
  }
}
