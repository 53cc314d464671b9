// The server's JSON API and its live messages.
//
//   const game = await getJson('/api/games/17');
//   const live = watch('/ws/games/17', (message) => show(message), (state) => note(state));
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
    this.status = status;
  }
}

/** @param {Response} response */
async function refused(response) {
  const body = await response.json().catch(() => null);
  return new ApiError(response.status, body?.error?.reason ?? response.statusText,
    body?.error?.field);
}

/**
 * @param {string} path
 * @param {RequestInit} [options]
 * @returns {Promise<string>}
 */
async function ask(path, options) {
  const response = await fetch(path, options).catch(() => {
    throw new ApiError(0, 'the server does not answer');
  });
  if (!response.ok) {
    throw await refused(response);
  }
  return response.text();
}

/**
 * @param {string} path
 * @param {AbortSignal} [signal]
 */
export async function getJson(path, signal) {
  return JSON.parse(await ask(path, { signal }));
}

/**
 * The text of the answer, as it came.
 * @param {string} path
 * @param {unknown} body
 */
export function postForText(path, body) {
  return ask(path, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(body),
  });
}

const firstPause = 250;
const longestPause = 8000;

/**
 * Listens to a live stream; comes back by itself when the connection is lost.
 * @param {string} path
 * @param {(message: any) => void} onMessage
 * @param {(state: 'open' | 'lost') => void} onState
 */
export function watch(path, onMessage, onState = () => {}) {
  let pause = firstPause;
  let closed = false;
  /** @type {number | undefined} */
  let timer;
  /** @type {WebSocket | undefined} */
  let socket;
  const connect = () => {
    const scheme = location.protocol === 'https:' ? 'wss:' : 'ws:';
    socket = new WebSocket(`${scheme}//${location.host}${path}`);
    socket.onopen = () => {
      pause = firstPause;
      onState('open');
    };
    socket.onmessage = (event) => onMessage(JSON.parse(event.data));
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

/**
 * A pause between calls: the first at once, then no more often than this; the last is never lost.
 * @param {number} milliseconds
 * @param {() => void} action
 */
export function throttled(milliseconds, action) {
  let next = 0;
  /** @type {number | undefined} */
  let timer;
  const run = () => {
    timer = undefined;
    next = performance.now() + milliseconds;
    action();
  };
  const call = () => {
    if (timer === undefined) {
      timer = setTimeout(run, Math.max(0, next - performance.now()));
    }
  };
  call.cancel = () => clearTimeout(timer);
  return call;
}
