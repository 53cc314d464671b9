// A spectator without a browser: a WebSocket that can stop reading, and say who it comes from.
//
//   const spectator = await Spectator.watch(server.http, '/ws/games/17');
//   await spectator.next((m) => m.type === 'turn');
import { randomBytes } from 'node:crypto';
import { connect } from 'node:net';
import { until } from './program.mjs';

export class Spectator {
  static async watch(address, path, { origin, host = address } = {}) {
    const [name, port] = address.split(':');
    const spectator = new Spectator();
    spectator.socket = connect(Number(port), name);
    spectator.socket.on('error', () => {});
    spectator.socket.on('data', (data) => spectator.receive(data));
    spectator.socket.write([`GET ${path} HTTP/1.1`, `Host: ${host}`, 'Upgrade: websocket', 'Connection: Upgrade',
      'Sec-WebSocket-Version: 13', `Sec-WebSocket-Key: ${randomBytes(16).toString('base64')}`,
      ...(origin ? [`Origin: ${origin}`] : []), '', ''].join('\r\n'));
    await until(() => spectator.head !== null, 'an answer to the handshake');
    return spectator;
  }

  constructor() {
    this.head = null;
    this.rest = Buffer.alloc(0);
    this.messages = [];
    this.bytes = 0;
  }

  get status() {
    return Number(this.head.split(' ')[1]);
  }

  receive(data) {
    this.bytes += data.length;
    this.rest = Buffer.concat([this.rest, data]);
    if (this.head === null) {
      const end = this.rest.indexOf('\r\n\r\n');
      if (end < 0) {
        return;
      }
      this.head = this.rest.subarray(0, end).toString();
      this.rest = this.rest.subarray(end + 4);
    }
    while (this.takeFrame());
  }

  /** RFC 6455, 5.2; a server's frames have no mask. */
  takeFrame() {
    const { rest } = this;
    if (this.status !== 101 || rest.length < 2) {
      return false;
    }
    let [begin, length] = [2, rest[1] & 0x7f];
    if (length === 126 && rest.length >= 4) {
      [begin, length] = [4, rest.readUInt16BE(2)];
    } else if (length === 127 && rest.length >= 10) {
      [begin, length] = [10, Number(rest.readBigUInt64BE(2))];
    } else if (length >= 126) {
      return false;
    }
    if (rest.length < begin + length) {
      return false;
    }
    if ((rest[0] & 0x0f) === 1) {
      this.messages.push(JSON.parse(rest.subarray(begin, begin + length).toString()));
    }
    this.rest = rest.subarray(begin + length);
    return true;
  }

  async next(wanted, what = 'a message', milliseconds = 10_000) {
    return until(() => {
      while (this.messages.length > 0) {
        const message = this.messages.shift();
        if (wanted(message)) {
          return message;
        }
      }
      return null;
    }, what, milliseconds);
  }

  leave() {
    this.socket.destroy();
  }
}
