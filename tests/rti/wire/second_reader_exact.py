"""The messages of the policy "exact" by docs/wire.md, "Exact", alone: every bit of each, without computing what a client would. Python's standard library only."""
import math
import struct

from second_reader_parts import golomb, signed

PUCK, BAT, POST = range(3)
STEP, PACE = 2.0**-20, 2.0**-17  # of places and velocities on the network grid
KEY_STEPS = (1e-6, 2.0**-16)


def f64(bits):
    return struct.unpack("<d", struct.pack("<Q", bits.number(64)))[0]


def bits_of(value):
    return struct.unpack("<Q", struct.pack("<d", value))[0]


def below(bits, end):
    size = end.bit_length() - 1
    short = 2 ** (size + 1) - end
    value = bits.number(size)
    if value >= short:
        value = 2 * value + bits.number(1) - short
    assert value < end, "beyond its range"
    return value


def rising(bits, order):
    """Numbers or ranks of a list, as they come."""
    last = -1
    while True:
        last += 1 + golomb(bits, order)
        yield last


def near(bits, exponent):
    sign, off, mantissa = bits.number(1), signed(golomb(bits, 2)), bits.number(52)
    return struct.unpack("<d", struct.pack("<Q", sign << 63 | (1023 + exponent - off) << 52 | mantissa))[0]


def like(bits, value):
    width = bits.number(7)
    differing = (bits.number(width - 1) | 1 << width - 1) if width else 0
    return struct.unpack("<d", struct.pack("<Q", bits_of(value) ^ differing))[0]


def foretold(bits, expected):
    return (expected + signed(golomb(bits, 0))) % 2**64 if bits.number(1) else bits.number(64)


def count_of(time, rate):
    return math.floor(abs(time) * rate + 0.5)


class ExactConversation:
    """Who is known to one client, which ranks refer to, and the instant before."""

    def __init__(self):
        self.start, self.time, self.tag, self.bodies = None, 0.0, 0, []  # bodies: [number, class, drive], by number

    def read_start(self, bits):
        assert bits.number(8) == 2, "another version"
        self.length, self.width, _ = (f64(bits) for _ in range(3))
        bits.number(8), bits.number(1)
        for _ in range(4):
            f64(bits)
        bits.number(1)
        materials, is_rough = bits.number(8) + 1, bits.number(1)
        for _ in range(materials * (materials + 1) // 2 * (3 if is_rough else 1)):
            f64(bits)
        self.grid_rate, self.tick_s, self.object_base = f64(bits), f64(bits), bits.number(32)
        self.kinds = []
        for _ in range(golomb(bits, 0)):
            self.kinds.append(bits.number(2))
            bits.number(2), bits.number(2), bits.number(8)
            for _ in range((2, 4, 1)[self.kinds[-1]]):
                f64(bits)
        posts = golomb(bits, 0)
        for _, _ in zip(range(posts), rising(bits, 8)):
            assert self.kinds[bits.number((len(self.kinds) - 1).bit_length())] == POST
            assert 0.0 <= f64(bits) <= self.length and 0.0 <= f64(bits) <= self.width
        self.start, self.time, self.tag, self.bodies = True, 0.0, 0, []

    def read_instant(self, bits):
        expected, passed = self.time + self.tick_s, count_of(self.tick_s, 1e9)
        if bits.number(1):
            return expected, self.tag + passed + signed(golomb(bits, 0))
        time = struct.unpack("<d", struct.pack("<Q", foretold(bits, bits_of(expected))))[0]
        return time, foretold(bits, self.tag + count_of(time - self.time, 1e9)) if bits.number(1) else 0

    def read_keys(self, bits, time):
        many, form = golomb(bits, 2), golomb(bits, 0)
        bats = [body for body in self.bodies if self.kinds[body[1]] == BAT]
        last = 0 if form == 2 else math.floor(self.time / KEY_STEPS[form]) if form == 1 else math.floor(self.time * 1e6)
        latest = self.time
        for _ in range(many):
            if form == 2:
                instant = f64(bits)
            else:
                last += golomb(bits, (11, 6)[form])
                instant = last / 1e6 if form == 0 else last * KEY_STEPS[1]
            assert latest <= instant <= time, "a key of another tick"
            latest, bat = instant, bats[below(bits, len(bats))]
            if not bits.number(1):
                bat[2] = [bits.number(2) - 1, bits.number(2) - 1]
                continue
            axis = bits.number(1)
            bat[2][axis] = 0 if bat[2][axis] else (1 if bits.number(1) else -1)
        return many

    def partner(self, bits):
        return golomb(bits, 8) if bits.number(1) else bits.number(4)

    def read_rest(self, bits):
        law, impacts, hops, slide, spin, lasting = (bits.number(1) for _ in range(6))
        for _ in range(4 * law + 2 * impacts):
            f64(bits)
        bits.number(64 * impacts)
        if hops:
            f64(bits), bits.number(32)
        for _ in range(3 * slide + spin):
            f64(bits)
        if not lasting:
            return
        bits.number(8), bits.number(2), golomb(bits, 8)
        for _ in range(golomb(bits, 0)):
            self.partner(bits), self.partner(bits), bits.number(1)
            for _ in range(4):
                f64(bits)
            bits.number(1 + 3 * 32)
        for _ in range(golomb(bits, 0)):
            golomb(bits, 8)

    def read_state(self, bits, kind, now):
        drive = [bits.number(2) - 1, bits.number(2) - 1] if kind == BAT else None
        if self.grid_rate > 0.0 and bits.number(1):
            golomb(bits, 3)
            margin = 2**20
            x, y = ((below(bits, math.ceil(side / STEP) + 2 * margin) - margin) * STEP for side in (self.length, self.width))
            vx, vy = signed(golomb(bits, 17)) * PACE, signed(golomb(bits, 17)) * PACE
        else:
            x, y, vx, vy = near(bits, 3), near(bits, 2), near(bits, -1), near(bits, -1)
            assert like(bits, now) <= now, "a flight that is still to begin"
        assert -2.0 <= x <= self.length + 2.0 and -2.0 <= y <= self.width + 2.0 and math.hypot(vx, vy) < 1000.0, "no body's state"
        if not bits.number(1):
            self.read_rest(bits)
        return drive

    def read(self, content, new_bits):
        bits = new_bits(content)
        has_start = bits.number(1)
        if has_start:
            self.read_start(bits)
        assert self.start, "a conversation without a beginning"
        time, tag = self.read_instant(bits)
        has_keys, has_changes, has_felt, has_hash = (bits.number(1) for _ in range(4))
        counts = {"keys": self.read_keys(bits, time) if has_keys else 0, "told": 0, "exits": 0, "returns": 0, "entries": 0}
        if has_changes:
            counts["told"] = golomb(bits, 0)
            for _, rank in zip(range(counts["told"]), rising(bits, 4)):
                body = self.bodies[rank]
                body[2] = self.read_state(bits, self.kinds[body[1]], time)
            counts["exits"], gone = golomb(bits, 0), []
            for _, rank in zip(range(counts["exits"]), rising(bits, 4)):
                lingers = bits.number(1)
                if not lingers:
                    gone.append(rank)
                    if bits.number(1):
                        bits.number(1)
            counts["returns"] = golomb(bits, 0)
            for _, rank in zip(range(counts["returns"]), rising(bits, 4)):
                assert rank < len(self.bodies)
            assert not gone or gone[-1] < len(self.bodies)
            self.bodies = [body for rank, body in enumerate(self.bodies) if rank not in gone]
            counts["entries"] = golomb(bits, 0)
            for _, number in zip(range(counts["entries"]), rising(bits, 8)):
                signed(golomb(bits, 0))
                each = below(bits, len(self.kinds))
                if self.kinds[each] == BAT:
                    golomb(bits, 5)
                drive = self.read_state(bits, self.kinds[each], time) if self.kinds[each] != POST else None
                self.bodies.append([number, each, drive])
            self.bodies.sort(key=lambda body: body[0])
        if has_felt:
            golomb(bits, 8)
        if has_hash:
            bits.number(32)
        assert bits.whole_bytes() == len(content), "all of it"
        self.time, self.tag = time, tag
        line = "exact %016x %d" % (bits_of(time), tag) + (" start" if has_start else "") + "".join(" %s %d" % each for each in counts.items())
        return [line + " known %d" % len(self.bodies) + (" hash" if has_hash else "")]
