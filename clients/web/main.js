// Which view is on the screen: the part of the address behind the #.
//
//   #/   #/tournaments/demo   #/games/17/shots/3?t=1.25   #/agents/greedy   #/workbench

import { AgentsView, AgentView } from './agents_view.js';
import { fill, h } from './dom.js';
import { GameView } from './game_view.js';
import { TournamentView } from './tournament_view.js';
import { TournamentsView } from './tournaments_view.js';
import { WorkbenchView } from './workbench_view.js';

/** @typedef {{open(): Promise<void>, close(): void, key?(event: KeyboardEvent): boolean,
 *   goTo?(where: any): Promise<void>}} View */

const root = /** @type {HTMLElement} */ (document.querySelector('#main'));

/** @type {View | null} */
let view = null;
let shown = '';

/** @param {string} text */
const numberIn = (text) => (/^\d{1,15}$/.test(text ?? '') ? Number(text) : undefined);

/**
 * What is no escape stays as it is: it names nothing then.
 * @param {string} part
 */
function decoded(part) {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

/**
 * What an address asks for.
 * @param {string} hash
 */
export function route(hash) {
  const [path, query = ''] = hash.replace(/^#\/?/, '').split('?');
  const parts = path.split('/').filter(Boolean).map(decoded);
  const parameters = new URLSearchParams(query);
  const t = parameters.get('t');
  return {
    page: parts[0] ?? 'tournaments',
    name: parts[1],
    shot: parts[2] === 'shots' ? numberIn(parts[3]) : undefined,
    t: t === null || !Number.isFinite(Number(t)) ? undefined : Number(t),
    parameters,
  };
}

/**
 * @param {ReturnType<typeof route>} where
 * @returns {View | null}
 */
function viewFor(where) {
  const id = numberIn(where.name);
  if (where.page === 'games' && id !== undefined) {
    return new GameView(root, { id, shot: where.shot, t: where.t });
  }
  if (where.page === 'tournaments') {
    return where.name ? new TournamentView(root, where.name) : new TournamentsView(root);
  }
  if (where.page === 'agents') {
    return where.name ? new AgentView(root, where.name) : new AgentsView(root);
  }
  return where.page === 'workbench' ? new WorkbenchView(root, where.parameters) : null;
}

/** @param {unknown} error */
function complain(error) {
  if (error instanceof DOMException && error.name === 'AbortError') {
    return;
  }
  fill(root, h('p', { class: 'notice', role: 'alert' },
    error instanceof Error ? error.message : String(error), '. '),
  h('p', {}, h('a', { href: '#/' }, 'To the tournaments')));
}

async function show() {
  const where = route(location.hash);
  const key = `${where.page}/${where.name ?? ''}`;
  if (key === shown && view?.goTo) {
    try {
      await view.goTo({ shot: where.shot, t: where.t });
    } catch (error) {
      shown = '';  // what is on the screen now is the complaint
      complain(error);
    }
    return;
  }
  view?.close();
  shown = key;
  document.title = where.name
    ? `${where.page === 'games' ? 'Game ' : ''}${where.name} - Poolhall` : 'Poolhall';
  for (const link of document.querySelectorAll('header nav a')) {
    const own = route(link.getAttribute('href') ?? '').page === where.page;
    if (own) {
      link.setAttribute('aria-current', 'page');
    } else {
      link.removeAttribute('aria-current');
    }
  }
  root.replaceChildren();
  for (const name of Object.keys(root.dataset)) {
    delete root.dataset[name];
  }
  view = viewFor(where);
  if (!view) {
    complain(new Error('There is no such page'));
    return;
  }
  const opening = view;
  // For tests and the curious: what is on the screen, in numbers.
  Object.assign(window, { poolhall: { view } });
  try {
    await view.open();
    root.dataset.ready = key;
  } catch (error) {
    if (view === opening) {
      shown = '';
      complain(error);
    }
  }
}

window.addEventListener('hashchange', () => show().catch(complain));
window.addEventListener('keydown', (event) => {
  const field = event.target instanceof HTMLElement
    && event.target.closest('input:not([type=range]), select, textarea, button, a, summary');
  const typed = field || event.ctrlKey || event.metaKey || event.altKey;
  if (!typed && view?.key?.(event)) {
    event.preventDefault();
  }
});
show().catch(complain);
