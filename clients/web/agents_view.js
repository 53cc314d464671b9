// Agents and their ratings over time.

import { getJson } from './api.js';
import { lineChart, seriesColour } from './charts.js';
import { fill, h } from './dom.js';
import { dateText, endingWords } from './words.js';

const mostSeries = 8;
/** Of a normal distribution, 95 %. */
const sure = 1.96;

/** @param {any} agent */
const seriesOf = (agent) => ({
  label: agent.agent,
  points: agent.history.map((/** @type {any} */ p) =>
    ({ x: p.games, y: p.rating, margin: sure * p.deviation })),
});

/** @param {any} agent */
const ratingText = (agent) => (agent.games > 0
  ? `${agent.rating.toFixed(0)} ± ${(sure * agent.deviation).toFixed(0)}` : '');

const method = 'Glicko-2 over all scored games, in the order in which they ended, in periods of ten games; '
  + 'the band is the 95 % interval.';

export class AgentsView {
  /** @param {HTMLElement} root */
  constructor(root) {
    this.root = root;
    this.abort = new AbortController();
  }

  async open() {
    const { agents } = await getJson('/api/agents', this.abort.signal);
    agents.sort((/** @type {any} */ a, /** @type {any} */ b) =>
      Number(b.games > 0) - Number(a.games > 0) || b.rating - a.rating);
    const charted = agents.filter((/** @type {any} */ a) => a.history.length > 0).slice(0, mostSeries);
    const head = ['', 'Agent', 'Rating', 'Games', 'Won', 'Lost', 'Drawn', ''];
    fill(this.root, h('h1', {}, 'Agents'),
      h('div', { class: 'columns' },
        h('section', {}, h('div', { class: 'scroll' }, h('table', { class: 'data' },
          h('thead', {}, h('tr', {}, head.map((text, i) => h('th', { scope: 'col', class: i > 1 ? 'num' : '' }, text)))),
          h('tbody', {}, agents.map((/** @type {any} */ agent) => {
            const place = charted.indexOf(agent);
            const key = h('span', { class: 'key' });
            key.style.background = place >= 0 ? seriesColour(place) : 'transparent';
            return h('tr', {}, h('td', {}, key),
              h('th', { scope: 'row' }, h('a', { href: `#/agents/${encodeURIComponent(agent.agent)}`, title: agent.agent }, agent.agent)),
              [ratingText(agent), agent.games, agent.wins, agent.losses, agent.draws]
                .map((value) => h('td', { class: 'num' }, value)),
              h('td', {}, agent.house ? h('span', { class: 'tag' }, 'house') : ''));
          }))))),
        h('section', {}, charted.length > 0
          ? lineChart(charted.map(seriesOf), 'Ratings over time', 'games played')
          : h('p', { class: 'dim' }, 'No game has been scored yet.'), h('p', { class: 'dim' }, method))));
  }

  close() {
    this.abort.abort();
  }
}

export class AgentView {
  /**
   * @param {HTMLElement} root
   * @param {string} name
   */
  constructor(root, name) {
    this.root = root;
    this.name = name;
    this.abort = new AbortController();
  }

  async open() {
    const agent = await getJson(`/api/agents/${encodeURIComponent(this.name)}`, this.abort.signal);
    fill(this.root,
      h('nav', { class: 'crumbs' }, h('a', { href: '#/agents' }, 'Agents'),
        h('span', { 'aria-current': 'page' }, agent.agent), agent.house && h('span', { class: 'tag' }, 'house')),
      h('p', { class: 'figures' },
        h('span', {}, h('b', {}, ratingText(agent) || 'unrated'), ' rating'),
        h('span', {}, h('b', {}, agent.games), ' games'), h('span', {}, h('b', {}, agent.wins), ' won'),
        h('span', {}, h('b', {}, agent.losses), ' lost'),
        agent.draws > 0 && h('span', {}, h('b', {}, agent.draws), ' drawn')),
      h('div', { class: 'columns' },
        h('section', {}, h('h2', {}, 'Rating over time'), agent.history.length > 0
          ? lineChart([seriesOf(agent)], `Rating of ${agent.agent}`, 'games played')
          : h('p', { class: 'dim' }, 'No game has been scored yet.'), h('p', { class: 'dim' }, method)),
        h('section', {}, h('h2', {}, 'Last games'), this.games(agent))));
  }

  /** @param {any} agent */
  games(agent) {
    return h('div', { class: 'scroll' }, h('table', { class: 'data' },
      h('thead', {}, h('tr', {}, ['Game', 'Against', 'Result', 'When'].map((t) => h('th', { scope: 'col' }, t)))),
      h('tbody', {}, agent.last_games.map((/** @type {any} */ game) => {
        const seat = game.agents[0] === agent.agent ? 0 : 1;
        const word = game.winner === null ? 'drawn' : game.winner === seat ? 'won' : 'lost';
        return h('tr', {}, h('td', { class: 'num' }, h('a', { href: `#/games/${game.game}` }, game.game)),
          h('td', {}, game.agents[1 - seat]), h('td', { class: word }, `${word}, ${endingWords(game.reason)}`),
          h('td', { class: 'dim' }, dateText(game.finished_ms)));
      }))));
  }

  close() {
    this.abort.abort();
  }
}
