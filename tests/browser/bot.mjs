// A player for the tests: speaks the agents' protocol, and strokes as it is told.
//
//   const anna = await Bot.join(server.agents, 'anna');
//   anna.onTurn = (turn) => anna.shoot(turn, { phi: 90, v: 3 });
import { connect } from 'node:net';

export class Bot {
  static async join(address, name, token = undefined) {
    const [host, port] = address.split(':');
    const bot = new Bot();
    bot.socket = connect(Number(port), host);
    await new Promise((resolve, reject) => bot.socket.once('connect', resolve).once('error', reject));
    bot.socket.on('error', () => {});
    bot.listen();
    await bot.ask('hello', { protocol: [1, 1], name: 'page-tests' });
    const reply = token ? await bot.ask('login', { token }) : await bot.ask('register', { name });
    bot.token = token ?? reply.token;
    return bot;
  }

  constructor() {
    this.next = 1;
    this.pending = new Map();
    this.onTurn = () => {};
    this.onOver = () => {};
  }

  listen() {
    let rest = '';
    this.socket.setEncoding('utf8');
    this.socket.on('data', (text) => {
      const lines = (rest + text).split('\n');
      rest = lines.pop();
      lines.forEach((line) => this.receive(JSON.parse(line)));
    });
  }

  receive(message) {
    if (message.id !== undefined) {
      const { resolve, reject } = this.pending.get(message.id);
      this.pending.delete(message.id);
      if (message.error) {
        reject(new Error(message.error.message));
      } else {
        resolve(message.result);
      }
    } else if (message.method === 'game.turn') {
      this.turn = message.params;
      this.onTurn(message.params);
    } else if (message.method === 'game.over') {
      this.onOver(message.params);
    } else if (message.method === 'challenge.offer') {
      this.ask('challenge.accept', { challenge: message.params.challenge });
    }
  }

  ask(method, params) {
    const id = this.next++;
    this.socket.write(`${JSON.stringify({ jsonrpc: '2.0', id, method, params })}\n`);
    return new Promise((resolve, reject) => this.pending.set(id, { resolve, reject }));
  }

  /** A safety, with the cue ball where the turn allows it; a decision takes the first choice. */
  shoot(turn, { phi, v, theta = 30, a = 0, b = 5 }) {
    const { game, turn: number, kind, state, legal } = turn;
    if (kind === 'decision') {
      return this.ask('decide', { game, turn: number, choice: legal.decisions[0] });
    }
    return this.ask('shot', {
      game,
      turn: number,
      shot_id: number,
      params: { a, b, theta, phi, v },
      ...(state.ball_in_hand ? { cue_ball: { x: 0.558, y: 0.5 } } : {}),
      call: legal.calls.includes('safety') ? 'safety' : null,
    });
  }

  leave() {
    this.socket.destroy();
  }
}

/** Two players in a game against each other that play on by themselves, a stroke each `pause` ms.
 * What they strike depends on the turn's number alone. */
export async function playingPair(server, pause, tokens = []) {
  const [anna, bob] = await Promise.all(['anna', 'bob'].map((name, i) => Bot.join(server.agents, name, tokens[i])));
  const pair = { anna, bob, tokens: [anna.token, bob.token], last: null, over: false, paused: false };
  for (const bot of [anna, bob]) {
    bot.onTurn = (turn) => {
      pair.last = turn;
      setTimeout(() => {
        const stroke = turn.turn === 1 ? { phi: 90.3, v: 8, theta: 5, b: 2 }
          : { phi: (turn.turn * 137.5) % 360, v: 2 + (turn.turn % 4) };
        // Where the cue has no room, a higher one has; then somewhere else.
        bot.shoot(turn, stroke)
          .catch(() => bot.shoot(turn, { ...stroke, theta: 70 }))
          .catch(() => bot.shoot(turn, { ...stroke, theta: 70, phi: (stroke.phi + 90) % 360 }))
          .catch(() => {});
      }, pause);
    };
    if (bot.turn) {
      bot.onTurn(bot.turn);  // of a game that was going on
    }
  }
  pair.begin = () => anna.ask('challenge', { opponent: 'bob', clock: { game_ms: 600_000 } });
  // One game after the other.
  anna.onOver = () => {
    pair.over = true;
    pair.begin().catch(() => {});
  };
  pair.leave = () => [anna, bob].forEach((bot) => bot.leave());
  return pair;
}
