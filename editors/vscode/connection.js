// A program that speaks JSON-RPC on its standard input and output, as `rddl lsp` does.
'use strict';

const { spawn } = require('child_process');

class Connection {
  // `heard` is called with the method and parameters of each notification, `ended` when the program is gone.
  constructor(program, words, heard, ended) {
    this.heard = heard;
    this.waiting = new Map(); // by the id of a request: what to do with its answer
    this.number = 0;
    this.bytes = Buffer.alloc(0);
    this.child = spawn(program, words, { stdio: ['pipe', 'pipe', 'ignore'] });
    this.child.stdout.on('data', (bytes) => this.read(bytes));
    this.child.stdin.on('error', () => {}); // the end of the program is reported by itself
    this.child.on('error', (error) => this.end(error, ended));
    this.child.on('exit', (status) => this.end(new Error(`it ended with status ${status}`), ended));
  }

  end(error, ended) {
    if (this.isOver) return;
    this.isOver = true;
    for (const { reject } of this.waiting.values()) reject(error);
    this.waiting.clear();
    ended(error);
  }

  send(message) {
    if (this.isOver) return;
    const body = Buffer.from(JSON.stringify({ jsonrpc: '2.0', ...message }));
    this.child.stdin.write(`Content-Length: ${body.length}\r\n\r\n`);
    this.child.stdin.write(body);
  }

  notify(method, params) {
    this.send({ method, params });
  }

  // The result; `token` may cancel the request.
  request(method, params, token) {
    if (this.isOver) return Promise.reject(new Error('it has ended'));
    const id = ++this.number;
    if (token) token.onCancellationRequested(() => this.notify('$/cancelRequest', { id }));
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.send({ id, method, params });
    });
  }

  read(bytes) {
    this.bytes = Buffer.concat([this.bytes, bytes]);
    for (;;) {
      const head = this.bytes.indexOf('\r\n\r\n');
      if (head < 0) return;
      const length = Number(/Content-Length: (\d+)/i.exec(this.bytes.toString('latin1', 0, head))[1]);
      if (this.bytes.length < head + 4 + length) return;
      const message = JSON.parse(this.bytes.toString('utf8', head + 4, head + 4 + length));
      this.bytes = this.bytes.subarray(head + 4 + length);
      this.take(message);
    }
  }

  take(message) {
    if (message.method) {
      this.heard(message.method, message.params);
      return;
    }
    const waiting = this.waiting.get(message.id);
    if (!waiting) return;
    this.waiting.delete(message.id);
    if (message.error) waiting.reject(new Error(message.error.message));
    else waiting.resolve(message.result);
  }

  async stop() {
    try {
      await this.request('shutdown');
    } catch (error) {
      // It has ended already.
    }
    this.notify('exit');
  }
}

module.exports = { Connection };
