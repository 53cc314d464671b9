// A player in Node: logs in, keeps the connection, answers every turn with what `choose` says.
//
//   await play({ name: 'anna', challenge: { opponent: 'house:greedy' }, games: 1 }, (turn) => ({
//     params: { a: 0, b: 0, theta: 40, phi: 90, v: 3 },
//     cue_ball: turn.kind === 'shot' ? undefined : { x: 0.5, y: 0.5 },
//     call: turn.legal.calls.includes('safety') ? 'safety' : null,
//   }));
//
// The protocol is in protocol/README.md; what is passed on here is as it came.
import { connect as connectPlain } from 'node:net';
import { connect as connectTls } from 'node:tls';

const firstPause = 250;
const longestPause = 8000;

/** A refusal of the server. */
export class AgentError extends Error {
  /** @param {{message: string, data?: {code?: string, field?: string, retryable?: boolean, foul?: boolean}}} error */
  constructor(error) {
    super(error.message);
    this.name = 'AgentError';
    this.code = error.data?.code ?? '';
    this.field = error.data?.field ?? '';
    this.retryable = error.data?.retryable ?? false;
    this.foul = error.data?.foul ?? false;
  }
}

/**
 * Whether a new login would not help.
 * @param {unknown} error
 */
const isFinal = (error) => error instanceof AgentError && !error.retryable;

/** One connection: requests with answers, notifications as they come. */
export class Agent {
  /**
   * @param {{host?: string, port?: number, tls?: import('node:tls').ConnectionOptions | null}} where
   * @param {(method: string, params: any) => void} onNotification
   */
  constructor({ host = '127.0.0.1', port = 7777, tls = null }, onNotification) {
    this.next = 1;
    /** @type {Map<number, {resolve(result: any): void, reject(error: Error): void}>} */
    this.pending = new Map();
    this.onNotification = onNotification;
    /** @type {AgentError | null} said by the server before it closed the connection */
    this.farewell = null;
    this.socket = tls ? connectTls({ host, port, ...tls }) : connectPlain(port, host);
    this.socket.setNoDelay(true);
    this.closed = new Promise((resolve) => {
      this.socket.once('close', () => {
        this.pending.forEach(({ reject }) => reject(this.farewell ?? new Error('the connection is lost')));
        this.pending.clear();
        resolve(undefined);
      });
    });
    this.socket.on('error', () => {});
    this.readLines();
  }

  readLines() {
    let rest = '';
    this.socket.setEncoding('utf8');
    this.socket.on('data', (text) => {
      const lines = (rest + text).split('\n');
      rest = lines.pop() ?? '';
      lines.forEach((line) => this.receive(JSON.parse(line)));
    });
  }

  /** @param {any} message */
  receive(message) {
    if (message.method === 'lag') {
      this.notify('lag', { t: message.params.t });
    } else if (message.method) {
      this.onNotification(message.method, message.params);
    } else if (this.pending.has(message.id)) {
      const request = this.pending.get(message.id);
      this.pending.delete(message.id);
      if (message.error) {
        request?.reject(new AgentError(message.error));
      } else {
        request?.resolve(message.result);
      }
    } else if (message.error) {
      this.farewell = new AgentError(message.error);
    }
  }

  /**
   * @param {string} method
   * @param {any} params
   */
  notify(method, params) {
    this.socket.write(`${JSON.stringify({ jsonrpc: '2.0', method, params })}\n`);
  }

  /**
   * @param {string} method
   * @param {any} [params]
   * @returns {Promise<any>} the result; rejected with an AgentError
   */
  ask(method, params = {}) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.pending.set(id, { resolve, reject });
      this.socket.write(`${JSON.stringify({ jsonrpc: '2.0', id, method, params })}\n`);
    });
  }

  close() {
    this.socket.end();
  }
}

/**
 * @typedef {{host?: string, port?: number, tls?: import('node:tls').ConnectionOptions | null,
 *   name?: string, token?: string, challenge?: any, games?: number,
 *   onToken?: (token: string) => void, onGame?: (terms: any) => void,
 *   onShot?: (shot: any, terms: any) => void, onOver?: (over: any, terms: any) => void,
 *   onRefusal?: (error: AgentError, turn: any) => void}} PlayOptions
 * host, port: the server's; tls: options of node:tls, null for a plain connection
 * name: to register with; token: to log in with, instead
 * challenge: as in the protocol; made at once, and again after each game while more are wanted
 * games: after so many that are over it ends; unset: never by itself
 */

/** The games of one player, over as many connections as it takes. */
class Player {
  /**
   * @param {PlayOptions} options
   * @param {(turn: any, terms: any) => any} choose
   */
  constructor(options, choose) {
    this.options = options;
    this.choose = choose;
    this.token = options.token;
    /** @type {Map<number, any>} by game */
    this.terms = new Map();
    /** @type {Map<number, {turn: number, refusals: number, move: Promise<any>}>} the latest, by game */
    this.moves = new Map();
    this.over = 0;
    this.done = false;
    /** @type {unknown} */
    this.failure = undefined;
  }

  async run() {
    for (let pause = firstPause; !this.done;) {
      const agent = new Agent(this.options, (method, params) => this.hear(method, params));
      this.agent = agent;
      try {
        await this.logIn(agent);
        pause = firstPause;
        await agent.closed;
      } catch (error) {
        agent.close();
        await agent.closed;
        if (isFinal(error)) {
          throw error;
        }
      }
      if (isFinal(agent.farewell)) {
        throw agent.farewell;
      }
      if (!this.done) {
        await new Promise((resolve) => { setTimeout(resolve, pause); });
        pause = Math.min(longestPause, 2 * pause);
      }
    }
    return { games: this.over, token: this.token };
  }

  /** @param {Agent} agent */
  async logIn(agent) {
    await agent.ask('hello', { protocol: [1, 1], name: 'poolhall-js' });
    const reply = this.token ? await agent.ask('login', { token: this.token })
      : await agent.ask('register', { name: this.options.name });
    if (!this.token) {
      this.token = reply.token;
      this.options.onToken?.(reply.token);
    }
    const goesOn = reply.games.some((/** @type {any} */ game) => game.status === 'running');
    if (!goesOn) {
      this.challenge();
    }
  }

  challenge() {
    if (this.options.challenge) {
      this.agent?.ask('challenge', this.options.challenge).catch((error) => this.end(error));
    }
  }

  /** @param {unknown} [failure] */
  end(failure) {
    this.done = true;
    this.failure ??= failure;
    this.agent?.close();
  }

  /**
   * @param {string} method
   * @param {any} params
   */
  hear(method, params) {
    switch (method) {
      case 'challenge.offer':
        this.agent?.ask('challenge.accept', { challenge: params.challenge }).catch(() => {});
        break;
      case 'game.start':
      case 'game.state':
        this.terms.set(params.game, params);
        this.options.onGame?.(params);
        break;
      case 'game.turn':
        this.answer(params);
        break;
      case 'game.shot':
        this.options.onShot?.(params, this.terms.get(params.game));
        break;
      case 'game.over':
        this.gameOver(params);
        break;
      case 'match.over':
        this.agent?.ask('ack', { match: params.match }).catch(() => {});
        break;
      case 'tournament.over':
        this.agent?.ask('ack', { tournament: params.tournament }).catch(() => {});
        break;
      case 'superseded':
        this.end();
        break;
      default:
        break;
    }
  }

  /**
   * The move of a turn: chosen once, however often the turn is handed out, because a shot_id must
   * never stand for two shots.
   * @param {any} turn
   * @returns {Promise<any>}
   */
  chosen(turn) {
    const { game, turn: number, refusals } = turn;
    const known = this.moves.get(game);
    if (known && known.turn === number && known.refusals === refusals) {
      return known.move;
    }
    const move = (async () => this.choose(turn, this.terms.get(game)))();
    this.moves.set(game, { turn: number, refusals, move });
    return move;
  }

  /** @param {any} turn */
  async answer(turn) {
    const agent = this.agent;
    const { game, turn: number } = turn;
    try {
      const move = await this.chosen(turn);
      if (move === 'concede') {
        await agent?.ask('concede', { game });
      } else if (move.choice) {
        await agent?.ask('decide', { game, turn: number, choice: move.choice });
      } else {
        const own = await agent?.ask('shot', { game, turn: number, shot_id: `${number}.${turn.refusals}`, ...move });
        this.options.onShot?.(own, this.terms.get(game));
      }
    } catch (error) {
      this.refused(error, turn, agent);
    }
  }

  /**
   * What cannot be played is chosen again while the turn is ours, what failed for the moment is sent
   * again a little later; an error of `choose` ends it all.
   * @param {unknown} error
   * @param {any} turn
   * @param {Agent | undefined} agent
   */
  refused(error, turn, agent) {
    if (!(error instanceof AgentError)) {
      if (!this.agent?.socket.destroyed) {
        this.end(error);
      }
      return;
    }
    if (error.retryable) {
      setTimeout(() => {
        // After a new login the turn is handed out again.
        if (agent === this.agent && !agent?.socket.destroyed) {
          this.answer(turn);
        }
      }, firstPause);
      return;
    }
    this.options.onRefusal?.(error, turn);
    if (error.code.startsWith('bad_') && !error.foul) {
      this.answer({ ...turn, refusals: turn.refusals + 1, refusal: error });
    }
  }

  /** @param {any} over */
  async gameOver(over) {
    const terms = this.terms.get(over.game);
    this.terms.delete(over.game);
    this.moves.delete(over.game);
    this.options.onOver?.(over, terms);
    await this.agent?.ask('ack', { game: over.game }).catch(() => {});
    this.over += 1;
    if (this.options.games !== undefined && this.over >= this.options.games) {
      this.end();
    } else {
      this.challenge();
    }
  }
}

/**
 * Plays until `games` are over; comes back by itself when the connection is lost. `choose` gives
 * `{params, cue_ball?, call?}`, `{choice}` or 'concede', or a promise of it; after a refusal it is
 * asked again, `turn.refusal` says why.
 * @param {PlayOptions} options
 * @param {(turn: any, terms: any) => any} choose
 * @returns {Promise<{games: number, token: string | undefined}>}
 */
export async function play(options, choose) {
  const player = new Player(options, choose);
  const result = await player.run();
  if (player.failure) {
    throw player.failure;
  }
  return result;
}
