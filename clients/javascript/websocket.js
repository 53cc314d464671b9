// The part of the browsers' WebSocket that this client needs, for a Node that has none: text that
// comes, pings that are answered, the end.
//
//   const socket = new WebSocket('ws://127.0.0.1:8080/ws/lobby');
//   socket.onmessage = ({ data }) => console.log(data);
//   socket.close();
import { createHash, randomBytes } from 'node:crypto';
import { request as httpRequest } from 'node:http';
import { request as httpsRequest } from 'node:https';

const magic = '258EAFA5-E914-47DA-95CA-C5AB0DC85B11';
const opcodes = { more: 0, text: 1, close: 8, ping: 9, pong: 10 };

/** @param {string} key */
const acceptOf = (key) => createHash('sha1').update(key + magic).digest('base64');

/**
 * A client's frame: always masked, here always short.
 * @param {number} opcode
 * @param {Buffer} payload up to 125 bytes
 */
function frameOf(opcode, payload) {
  const mask = randomBytes(4);
  const masked = payload.map((byte, i) => byte ^ mask[i % 4]);
  return Buffer.concat([Buffer.from([0x80 | opcode, 0x80 | payload.length]), mask, masked]);
}

/**
 * The first frame in the bytes, or null while it is not whole.
 * @param {Buffer} bytes
 */
function frameIn(bytes) {
  if (bytes.length < 2) {
    return null;
  }
  const short = bytes[1] & 0x7f;
  const begin = short === 127 ? 10 : short === 126 ? 4 : 2;
  if (bytes.length < begin) {
    return null;
  }
  const length = short === 127 ? Number(bytes.readBigUInt64BE(2)) : short === 126 ? bytes.readUInt16BE(2) : short;
  if (bytes.length < begin + length) {
    return null;
  }
  return {
    opcode: bytes[0] & 0x0f,
    last: (bytes[0] & 0x80) !== 0,
    payload: bytes.subarray(begin, begin + length),
    rest: bytes.subarray(begin + length),
  };
}

export class WebSocket {
  /** @param {string} url ws: or wss: */
  constructor(url) {
    this.onopen = () => {};
    /** @type {(event: {data: string}) => void} */
    this.onmessage = () => {};
    this.onclose = () => {};
    this.ended = false;
    /** @type {Buffer} */
    this.bytes = Buffer.alloc(0);
    /** @type {Buffer[]} of a message whose last frame has not come */
    this.parts = [];
    const key = randomBytes(16).toString('base64');
    const ask = url.startsWith('wss:') ? httpsRequest : httpRequest;
    this.request = ask(url.replace(/^ws/, 'http'), {
      headers: { Connection: 'Upgrade', Upgrade: 'websocket', 'Sec-WebSocket-Version': '13', 'Sec-WebSocket-Key': key },
    });
    this.request.on('upgrade', (response, socket, head) => {
      if (response.headers['sec-websocket-accept'] !== acceptOf(key)) {
        this.end();
        return;
      }
      this.socket = socket;
      socket.on('data', (/** @type {Buffer} */ bytes) => this.take(bytes));
      socket.on('error', () => this.end());
      socket.on('close', () => this.end());
      this.onopen();
      this.take(head);
    });
    this.request.on('response', (response) => {
      response.resume();
      this.end();
    });
    this.request.on('error', () => this.end());
    this.request.end();
  }

  /** @param {Buffer} bytes */
  take(bytes) {
    this.bytes = Buffer.concat([this.bytes, bytes]);
    for (let frame = frameIn(this.bytes); frame && !this.ended; frame = frameIn(this.bytes)) {
      this.bytes = frame.rest;
      this.receive(frame);
    }
  }

  /** @param {{opcode: number, last: boolean, payload: Buffer}} frame */
  receive({ opcode, last, payload }) {
    if (opcode === opcodes.ping) {
      this.socket?.write(frameOf(opcodes.pong, payload));
    } else if (opcode === opcodes.close) {
      this.close();
    } else if (opcode === opcodes.text || opcode === opcodes.more) {
      this.parts.push(payload);
      if (last) {
        const data = Buffer.concat(this.parts).toString('utf8');
        this.parts = [];
        this.onmessage({ data });
      }
    }
  }

  close() {
    if (this.socket && !this.ended) {
      this.socket.end(frameOf(opcodes.close, Buffer.from([0x03, 0xe8])));
    }
    this.request.destroy();
    this.end();
  }

  end() {
    if (!this.ended) {
      this.ended = true;
      this.socket?.destroySoon?.();
      this.onclose();
    }
  }
}
