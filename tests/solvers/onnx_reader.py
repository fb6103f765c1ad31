"""Computes what small ONNX models say, without a package: as much of the format as rddl export writes.

Sources: onnx.proto (numbers of fields) and docs/Operators.md of https://github.com/onnx/onnx.
"""

import math
import struct


def fields(data):
    """The fields of a message of protocol buffers: number -> values, ints or bytes."""
    found, at = {}, 0

    def varint():
        nonlocal at
        value = shift = 0
        while True:
            byte = data[at]
            at += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    while at < len(data):
        key = varint()
        if key & 7 == 0:
            value = varint()
        else:
            assert key & 7 == 2, "other kinds of fields are not written"
            size = varint()
            value = data[at:at + size]
            at += size
        found.setdefault(key >> 3, []).append(value)
    return found


def tensor(data):
    """Its name and its numbers, as lists of lists."""
    its = fields(data)
    shape, raw = its.get(1, []), its[9][0]
    values = list(struct.unpack(f"<{len(raw) // 4}f", raw) if its[2] == [1] else struct.unpack("<q", raw))
    assert len(values) == math.prod(shape)
    for size in reversed(shape):
        values = [values[i:i + size] for i in range(0, len(values), size)]
    return its[8][0].decode(), values[0]


class Graph:
    def __init__(self, data):
        graph = fields(fields(data)[7][0])
        self.nodes = [self.node(each) for each in graph[1]]
        self.constants = dict(tensor(each) for each in graph[5])
        name = lambda info: fields(info)[1][0].decode()
        self.inputs, self.outputs = [name(i) for i in graph[11]], [name(i) for i in graph[12]]

    @staticmethod
    def node(data):
        its = fields(data)
        names = lambda number: [name.decode() for name in its.get(number, [])]
        attributes = [fields(each) for each in its.get(5, [])]
        return names(4)[0], names(1), names(2), {each[1][0].decode(): each[3][0] for each in attributes}

    def run(self, given):
        """The outputs, rows of a batch, of inputs that are rows of a batch."""
        values = {"": None, **self.constants, **given}
        for operation, inputs, outputs, attributes in self.nodes:
            results = getattr(self, operation.lower())(*(values[name] for name in inputs), **attributes)
            values.update(zip(outputs, results if isinstance(results, tuple) else (results,)))
        return {name: values[name] for name in self.outputs}

    @staticmethod
    def rows(function, a, b):
        """Combines rows with rows, or rows with one row for all of them."""
        return [[function(x, y) for x, y in zip(row, b[i] if isinstance(b[0], list) else b)] for i, row in enumerate(a)]

    def sub(self, a, b):
        return self.rows(lambda x, y: x - y, a, b)

    def mul(self, a, b):
        return self.rows(lambda x, y: x * y, a, b)

    def add(self, a, b):
        return self.rows(lambda x, y: x + y, a, b)

    def clip(self, a, least, most):
        return [[max(least, min(most, x)) for x in row] for row in a]

    def tanh(self, a):
        return [[math.tanh(x) for x in row] for row in a]

    def relu(self, a):
        return [[max(0.0, x) for x in row] for row in a]

    def gemm(self, a, b, c, transB):
        assert transB == 1
        return [[sum(x * y for x, y in zip(row, weights)) + bias for weights, bias in zip(b, c)] for row in a]

    def unsqueeze(self, a, axes):
        assert axes == [0]
        return [a]

    def squeeze(self, a, axes):
        assert axes == [0] and len(a) == 1
        return a[0]

    def concat(self, a, b, axis):
        assert axis == 1
        return [x + y for x, y in zip(a, b)]

    def gru(self, x, w, r, b, lengths, h, hidden_size, linear_before_reset):
        """The parts of w, r and b are z, r and h, in this order; b has those of w and then those of r. All of them
        have an axis of directions, of which there is one."""
        assert linear_before_reset == 1 and lengths is None and len(x) == len(h) == 1
        (w,), (r,), (b,), n = w, r, b, hidden_size
        states = []
        for row, state in zip(x[0], h[0]):
            of_input = self.gemm([row], w, b[:3 * n], transB=1)[0]
            of_state = self.gemm([state], r, b[3 * n:], transB=1)[0]
            z, reset = ([1 / (1 + math.exp(-of_input[i] - of_state[i])) for i in range(k * n, k * n + n)] for k in (0, 1))
            new = [math.tanh(of_input[2 * n + i] + reset[i] * of_state[2 * n + i]) for i in range(n)]
            states.append([(1 - z[i]) * new[i] + z[i] * state[i] for i in range(n)])
        return [states], [states]
