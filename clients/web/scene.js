// The balls of a turn, and its shot as a scene that `poolhall simulate` takes.
//
//   const motion = new Motion({ balls: ballsOf(turn.state_before), events: turn.events, physics });
//   const text = await postForText('/api/simulate', sceneOf(game, turn, turn.intended));

/**
 * The balls before a turn's first event.
 * @param {any} state
 */
export const ballsOf = (state) => state.balls
  .filter((/** @type {any} */ b) => b.pocket === undefined && !b.off_table);

/**
 * @param {any} game
 * @param {any} turn
 * @param {any} shot
 */
export function sceneOf(game, turn, shot) {
  const placed = turn.cue_ball;
  const balls = ballsOf(turn.state_before)
    .map((/** @type {any} */ b) => (b.id === 0 && placed ? { id: 0, ...placed } : { id: b.id, x: b.x, y: b.y }));
  if (placed && !balls.some((/** @type {any} */ b) => b.id === 0)) {
    balls.unshift({ id: 0, ...placed });
  }
  return { table: game.table, physics: game.physics, balls, shot };
}
