// A Poolhall server from Node, without dependencies.
//
//   import { hallAt, Motion, play } from './poolhall.js';
//   const hall = hallAt('http://127.0.0.1:8080');
//   const { board } = await hall.game(17);
//   const motion = motionOf(board, await hall.turn(17, 3));
//   motion.ballsAt(1.25);

import { ApiError, Poolhall } from '../web/api.js';
import { Motion } from '../web/motion.js';
import { Agent, AgentError, play } from './agent.js';
import { WebSocket } from './websocket.js';

export { Agent, AgentError, ApiError, Motion, Poolhall, play };

/**
 * The API and the live streams at an address such as http://127.0.0.1:8080.
 * @param {string} origin
 */
export const hallAt = (origin) => new Poolhall(origin, { WebSocket });

/**
 * Any instant of a turn that was played.
 * @param {any} board of the game
 * @param {any} turn
 */
export function motionOf(board, turn) {
  const onTable = (/** @type {any} */ ball) => ball.pocket === undefined && !ball.off_table;
  return new Motion({
    balls: turn.state_before.balls.filter(onTable), events: turn.events, physics: board.physics,
  });
}
