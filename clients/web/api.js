// The server's JSON API and its live messages, in a browser or in Node (clients/javascript).
//
//   const hall = new Poolhall('http://127.0.0.1:8080');
//   const game = await hall.game(17);
//   const live = hall.follow(17, (message) => show(message), (state) => note(state));
//   live.close();

/** A refusal of the server, or no answer at all (status 0). */
export class ApiError extends Error {
  /**
   * @param {number} status
   * @param {string} reason
   * @param {string} field
   */
  constructor(status, reason, field = '') {
    super(field ? `${field}: ${reason}` : reason);
    this.name = 'ApiError';
    this.status = status;
    this.field = field;
  }
}

/** @param {Response} response */
async function refused(response) {
  const body = await response.json().catch(() => null);
  return new ApiError(response.status, body?.error?.reason ?? response.statusText,
    body?.error?.field);
}

const firstPause = 250;
const longestPause = 8000;

/**
 * @typedef {{close(): void}} Listening
 * @typedef {(state: 'open' | 'lost') => void} OnState
 */

/** A server's page port. */
export class Poolhall {
  /**
   * @param {string} origin such as http://127.0.0.1:8080
   * @param {{WebSocket?: any}} [options] WebSocket: a class for where there is none
   */
  constructor(origin, { WebSocket } = {}) {
    this.origin = origin;
    this.WebSocket = WebSocket;
  }

  /**
   * @param {string} path
   * @param {RequestInit} [options]
   * @returns {Promise<string>}
   */
  async ask(path, options) {
    const response = await fetch(new URL(path, this.origin), options).catch((error) => {
      throw error.name === 'AbortError' ? error : new ApiError(0, 'the server does not answer');
    });
    if (!response.ok) {
      throw await refused(response);
    }
    return response.text();
  }

  /**
   * Any page of the API.
   * @param {string} path
   * @param {AbortSignal} [signal]
   * @returns {Promise<any>}
   */
  async getJson(path, signal) {
    return JSON.parse(await this.ask(path, { signal }));
  }

  /**
   * The text of the answer, as it came.
   * @param {string} path
   * @param {unknown} body
   */
  postForText(path, body) {
    return this.ask(path, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(body),
    });
  }

  /** @returns {Promise<any>} `{tournaments: [...]}` */
  tournaments() {
    return this.getJson('/api/tournaments');
  }

  /** @param {string} name */
  tournament(name) {
    return this.getJson(`/api/tournaments/${encodeURIComponent(name)}`);
  }

  /** @returns {Promise<any>} `{agents: [...]}` with ratings over time */
  agents() {
    return this.getJson('/api/agents');
  }

  /** @param {string} name */
  agent(name) {
    return this.getJson(`/api/agents/${encodeURIComponent(name)}`);
  }

  /** @returns {Promise<any>} `{games: [...]}`, those that go on */
  live() {
    return this.getJson('/api/live');
  }

  /**
   * A game: its terms, the numbers of its table (`board`), its turns, its result.
   * @param {number} id
   */
  game(id) {
    return this.getJson(`/api/games/${id}`);
  }

  /**
   * A turn with its whole event log.
   * @param {number} game
   * @param {number} turn
   */
  turn(game, turn) {
    return this.getJson(`/api/games/${game}/shots/${turn}`);
  }

  /**
   * What `poolhall simulate` prints of the scene.
   * @param {any} scene
   */
  async simulate(scene) {
    return JSON.parse(await this.postForText('/api/simulate', scene));
  }

  /**
   * Where the balls of a scene end under noise.
   * @param {{scene: any, noise: any, samples?: number, seed?: number}} request
   */
  async evaluate(request) {
    return JSON.parse(await this.postForText('/api/evaluate', request));
  }

  /**
   * A game as it goes on: `snapshot`, then `turn` after `turn` (server/web/README.md).
   * @param {number} game
   * @param {(message: any) => void} onMessage
   * @param {OnState} [onState]
   */
  follow(game, onMessage, onState) {
    return this.watch(`/ws/games/${game}`, onMessage, onState);
  }

  /**
   * Listens to a live stream; comes back by itself when the connection is lost.
   * @param {string} path
   * @param {(message: any) => void} onMessage
   * @param {OnState} [onState]
   * @returns {Listening}
   */
  watch(path, onMessage, onState = () => {}) {
    const Socket = this.WebSocket ?? globalThis.WebSocket;
    const url = new URL(path, this.origin.replace(/^http/, 'ws'));
    let pause = firstPause;
    let closed = false;
    /** @type {any} */
    let timer;
    /** @type {any} */
    let socket;
    const connect = () => {
      socket = new Socket(url.href);
      socket.onopen = () => {
        pause = firstPause;
        onState('open');
      };
      socket.onmessage = (/** @type {any} */ event) => onMessage(JSON.parse(event.data));
      socket.onclose = () => {
        if (closed) {
          return;
        }
        onState('lost');
        timer = setTimeout(connect, pause * (0.75 + Math.random() / 2));
        pause = Math.min(longestPause, pause * 2);
      };
    };
    connect();
    return {
      close() {
        closed = true;
        clearTimeout(timer);
        socket?.close();
      },
    };
  }
}

/** The server that this page comes from. */
const here = new Poolhall(globalThis.location?.origin ?? '');

/**
 * @param {string} path
 * @param {AbortSignal} [signal]
 */
export const getJson = (path, signal) => here.getJson(path, signal);

/**
 * @param {string} path
 * @param {unknown} body
 */
export const postForText = (path, body) => here.postForText(path, body);

/**
 * @param {string} path
 * @param {(message: any) => void} onMessage
 * @param {OnState} [onState]
 */
export const watch = (path, onMessage, onState) => here.watch(path, onMessage, onState);

/** What takes long is done seldom: it rests this many times as long. */
const restShare = 9;

/**
 * A pause between calls: the first at once, then no more often than this; the last is never lost.
 * @param {number} milliseconds
 * @param {() => Promise<void>} action
 */
export function throttled(milliseconds, action) {
  let next = 0;
  let isBusy = false;
  let isAsked = false;
  /** @type {any} */
  let timer;
  const run = async () => {
    timer = undefined;
    isBusy = true;
    isAsked = false;
    const began = performance.now();
    await action();
    const now = performance.now();
    next = Math.max(began + milliseconds, now + restShare * (now - began));
    isBusy = false;
    if (isAsked) {
      call();
    }
  };
  const call = () => {
    isAsked = true;
    if (timer === undefined && !isBusy) {
      timer = setTimeout(run, Math.max(0, next - performance.now()));
    }
  };
  call.cancel = () => clearTimeout(timer);
  return call;
}
