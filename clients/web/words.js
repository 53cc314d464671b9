// What the API says, in words for people.
//
//   rulingWords(ruling);          // ['Legal shot.', '3 in the foot left pocket.']
//   clockText(83_000);            // '1:23'

/** @param {string} code */
export const spaced = (code) => code.replaceAll('_', ' ');

/** @param {string} text */
export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

const actions = {
  decision: 'decided',
  lost_turn: 'lost the turn',
  concession: 'conceded',
  timeout: 'ran out of time',
  forfeit: 'forfeited',
  void_game: 'game void',
};

const decisions = {
  accept: 'plays on',
  accept_ball_in_hand: 'takes ball in hand',
  rerack_chooser_breaks: 'reracks and breaks',
  rerack_breaker_breaks: 'asks for a rerack',
  spot_eight: 'spots the 8',
  shoot: 'shoots',
  pass_back: 'passes back',
};

const endings = {
  eight_pocketed: '8 pocketed',
  eight_early: '8 pocketed too early',
  eight_wrong_pocket: '8 in the wrong pocket',
  eight_with_last: '8 with the last ball',
  eight_on_safety: '8 on a safety',
  eight_on_foul: '8 with a foul',
  eight_off_table: '8 off the table',
  nine_pocketed: '9 pocketed',
  three_fouls: 'three fouls in a row',
  void: 'void',
};

const eventNames = {
  cue_strike: 'strike',
  ball_collision: 'ball meets ball',
  rail_collision: 'rail',
  pocketed: 'pocketed',
  transition: 'transition',
  off_table: 'off the table',
};

/**
 * @param {Record<string, string>} words
 * @param {string} code
 */
const wordFor = (words, code) => words[code] ?? spaced(code);

/** @param {string} reason */
export const endingWords = (reason) => wordFor(endings, reason);

/**
 * Of a game that is over.
 * @param {any} game
 */
export function resultWords({ agents, winner, reason, scored }) {
  if (scored === false) {
    return 'void: it does not count';
  }
  return `${winner === null || winner === undefined ? 'drawn' : `${agents[winner]} won`}, ${endingWords(reason)}`;
}

/** @param {string} pocket */
export const pocketWords = (pocket) => `${spaced(pocket)} pocket`;

/**
 * @param {any} call
 * @returns {string}
 */
export function callWords(call) {
  if (!call) {
    return 'no call';
  }
  if (typeof call === 'string') {
    return spaced(call).replace('push out', 'push-out');
  }
  return `${call.ball} in the ${pocketWords(call.pocket)}`;
}

/** @param {number} milliseconds */
export function clockText(milliseconds) {
  const left = Math.max(0, milliseconds);
  if (left < 20_000) {
    return (Math.floor(left / 100) / 10).toFixed(1);
  }
  const seconds = Math.floor(left / 1000);
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${String(seconds % 60).padStart(2, '0')}`;
}

/** @param {any} event */
export function eventWords(event) {
  const who = event.balls.map((/** @type {number} */ b) => (b === 0 ? 'cue' : b)).join(' and ');
  const where = event.rail ? `${spaced(event.rail)} rail` : event.pocket ? pocketWords(event.pocket) : '';
  switch (event.type) {
    case 'cue_strike':
      return 'the cue strikes';
    case 'ball_collision':
      return `${who} meet`;
    case 'rail_collision':
      return `${who} at the ${where}`;
    case 'pocketed':
      return `${who} in the ${where}`;
    case 'transition':
      return `${who} ${event.after?.[0]?.state ?? 'changes'}`;
    default:
      return `${who}: ${wordFor(eventNames, event.type)}`;
  }
}

/**
 * @param {any} ruling
 * @returns {{text: string, kind: string}[]}
 */
export function rulingWords(ruling) {
  if (!ruling) {
    return [];
  }
  const lines = [];
  for (const foul of ruling.fouls ?? []) {
    lines.push({ text: `Foul: ${foul.text || spaced(foul.code)} (${foul.rule})`, kind: 'foul' });
  }
  for (const { ball, pocket } of ruling.pocketed ?? []) {
    lines.push({
      text: `${ball === 0 ? 'Cue ball' : ball} in the ${pocketWords(pocket)}.`,
      kind: ball === 0 ? 'foul' : 'pocketed',
    });
  }
  for (const ball of ruling.driven_off ?? []) {
    lines.push({ text: `${ball === 0 ? 'Cue ball' : ball} off the table.`, kind: 'foul' });
  }
  for (const note of ruling.notes ?? []) {
    lines.push({ text: `${note.text} (${note.rule})`, kind: 'note' });
  }
  if (lines.length === 0) {
    lines.push({ text: 'Legal shot, nothing pocketed.', kind: 'note' });
  }
  return lines;
}

/**
 * What was done in a turn, in a line.
 * @param {any} turn
 */
export function turnWords(turn) {
  if (turn.action === 'decision') {
    return wordFor(decisions, turn.choice);
  }
  if (turn.action !== 'shot') {
    return wordFor(actions, turn.action);
  }
  const down = (turn.ruling?.pocketed ?? [])
    .map((/** @type {any} */ p) => (p.ball === 0 ? 'cue ball' : p.ball));
  const call = typeof turn.call === 'string' ? callWords(turn.call) : '';
  return [call, down.length > 0 ? `${down.join(', ')} down` : '']
    .filter(Boolean).join(', ') || (turn.call ? 'missed' : 'nothing down');
}

/** @param {number} ms since 1970 */
export const dateText = (ms) => new Date(ms).toISOString().slice(0, 16).replace('T', ' ');

/**
 * @param {number} value
 * @param {number} digits
 */
export const signed = (value, digits = 0) => (value < 0 ? '−' : '+') + Math.abs(value).toFixed(digits);
