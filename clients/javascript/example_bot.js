#!/usr/bin/env node
// Plays a game of 8-ball against house:greedy by the ghost ball. Run `poolhall serve`, and in another
// terminal: node clients/javascript/example_bot.js 127.0.0.1:7777
import { play } from './poolhall.js';

const pockets = (table) => [['head', 0], ['side', table.length / 2], ['foot', table.length]].flatMap(
  ([end, y]) => [['left', 0], ['right', table.width]].map(([side, x]) => ({ name: `${end}_${side}`, x, y })));

/** Where the cue ball must touch the ball to send it towards the pocket, and how straight that is. */
function potOf(cue, ball, pocket, radius) {
  const away = Math.hypot(ball.x - pocket.x, ball.y - pocket.y);
  const [ux, uy] = [(ball.x - pocket.x) / away, (ball.y - pocket.y) / away];
  const ghost = { x: ball.x + 2 * radius * ux, y: ball.y + 2 * radius * uy };
  const reach = Math.hypot(ghost.x - cue.x, ghost.y - cue.y);
  return { ghost, straight: ((cue.x - ghost.x) * ux + (cue.y - ghost.y) * uy) / reach };  // 1: no cut
}

function freeSpot(balls, { width, head_string: y }) {
  const room = (x) => Math.min(...balls.map((b) => Math.hypot(b.x - x, b.y - 0.9 * y)));
  const spots = [...Array(99)].map((_, i) => (0.1 + 0.008 * i) * width);
  return { x: spots.reduce((best, x) => (room(x) > room(best) ? x : best)), y: 0.9 * y };
}

function choose(turn, { table, physics: { ball_radius: radius } }) {
  if (turn.kind === 'decision') {
    return { choice: turn.legal.decisions[0] };
  }
  const balls = turn.state.balls.filter((b) => b.x !== undefined && b.id !== 0);
  const cue = turn.kind === 'shot' ? turn.state.balls.find((b) => b.id === 0) : freeSpot(balls, table);
  let best = { ghost: table.foot_spot, straight: -1, call: null };  // for the break
  for (const ball of turn.kind === 'break' ? [] : balls.filter((b) => turn.legal.balls.includes(b.id))) {
    for (const pocket of pockets(table)) {
      const pot = potOf(cue, ball, pocket, radius);
      if (pot.straight >= best.straight) {
        best = { ...pot, call: { ball: ball.id, pocket: pocket.name } };
      }
    }
  }
  const phi = (Math.atan2(best.ghost.y - cue.y, best.ghost.x - cue.x) * 180) / Math.PI;
  // High enough for the cue to pass over rails, through the ball's centre.
  const params = { a: 0, b: 1000 * radius * Math.sin((40 * Math.PI) / 180), theta: 40, phi, v: best.call ? 3 : 9 };
  return { params, call: best.call, ...(turn.kind === 'shot' ? {} : { cue_ball: { x: cue.x, y: cue.y } }) };
}

const [host, port] = (process.argv[2] ?? '127.0.0.1:7777').split(':');
await play({
  host,
  port: Number(port),
  name: `example-${Math.floor(1e9 * Math.random())}`,
  challenge: { opponent: 'house:greedy' },
  games: 1,
  onOver: ({ winner, reason }, { seat }) => console.log(`game over: ${winner === seat ? 'won' : 'not won'}, ${reason}`),
}, choose);
