"""What the second reader knows beyond plain messages, by docs/wire.md alone: the codecs of the shipped model, the digest, baselines, admission, and datagrams over UDP. Python's standard library only."""
import hashlib
import math
import struct

ALL_ONES = 0xFFFFFFFF
FORMS = {"HLAfloat32": 1, "HLAfloat64": 2, "HLAinteger16": 3, "HLAinteger32": 4}
GREETING = 0x47444B52
DATAGRAM_MAX = 1200


def fnv1a(text, bits):
    value, prime = {64: (0xCBF29CE484222325, 0x100000001B3), 32: (0x811C9DC5, 0x01000193)}[bits]
    for byte in text.encode():
        value = (value ^ byte) * prime % 2**bits
    return value


# The model

SWITCHES = (("autoProvide", "0"), ("attributeScopeAdvisory", "1"), ("attributeRelevanceAdvisory", "0"), ("objectClassRelevanceAdvisory", "1"), ("interactionRelevanceAdvisory", "1"))
RESIGN_ACTIONS = ("UnconditionallyDivestAttributes", "DeleteObjects", "CancelPendingOwnershipAcquisitions", "DeleteObjectsThenDivest", "CancelThenDeleteThenDivest", "NoAction")


def switches(root):
    """As in the hash and the digest; empty if all are as they are without a table."""
    values, action = dict(SWITCHES), "4"
    for each in (each for table in root.iter("switches") for each in table):
        if each.tag in values:
            values[each.tag] = "1" if each.get("isEnabled") == "true" else "0"
        if each.tag == "automaticResignAction":
            action = str(RESIGN_ACTIONS.index(each.get("resignAction")))
    text = "".join(values[name] for name, _ in SWITCHES) + action
    return text if text != "".join(default for _, default in SWITCHES) + "4" else ""


def encoding(declared, otherwise):
    return ((declared.findtext("encoding") or "").split() or [otherwise])[0]


def codec_of(model, data_type):
    """The name of the codec of an attribute's data type, or nothing."""
    quantised = [line.split(" ", 2)[2] for line in codec_lines(model, {data_type})]
    return dict(model.codecs).get(data_type) or "".join(quantised)


def digest(model):
    """What a refused federate is sent of the federation's model."""
    elements = []

    def travel(element):
        names = sorted(each.text for each in element.findall("dimensions/dimension"))
        is_root = element.findtext("name") == "HLAinteractionRoot"
        return " %d %d" % (not is_root and element.findtext("transportation") == "HLAbestEffort", not is_root and element.findtext("order") == "TimeStamp") + "".join(" " + name for name in names)

    def add(outer, tag, member, word, path, periodic):
        for element in outer.findall(tag):
            name = ".".join(path + [element.findtext("name")])
            whose, told = "%s '%s'" % (word, name), periodic
            elements.append((whose, "" if member == "attribute" else travel(element)))
            for each in element.findall(member):
                data_type, size = each.findtext("dataType"), model.size(each.findtext("dataType"))
                content = "%s %d" % (data_type, ALL_ONES if size is None else size)
                if member == "attribute":
                    is_baselined = not told and each.findtext("updateType") == "Periodic" and is_quantised_throughout(model, data_type)
                    told = told or is_baselined
                    content += travel(each) + codec_of(model, data_type) + (" baselines" if is_baselined else "")
                elements.append(("%s '%s' of %s" % (member, each.findtext("name"), whose), content))
            add(element, tag, member, word, path + [element.findtext("name")], told)

    for outer in model.root.iter("objects"):
        add(outer, "objectClass", "attribute", "object class", [], False)
    for outer in model.root.iter("interactions"):
        add(outer, "interactionClass", "parameter", "interaction class", [], False)
    elements += [("dimension '%s'" % name, " %d" % upper) for name, upper in model.dimensions]
    elements += [("the table of switches", model.switches)] if model.switches else []
    return [(fnv1a(name, 32), fnv1a(content, 32)) for name, content in elements]


# The codecs of the shipped model

def twos_complement(bits, count):
    number = bits.number(count)
    return number - (number >> count - 1 << count)


def grid_pair(bits, count, middle=0.0):
    return [twos_complement(bits, count) * 2.0**-11 + middle for _ in "xy"]


def trajectory_time(bits, stamp):
    """The latest instant with the fourteen bits that is at most half a second after the stamp."""
    latest, residue = math.floor((seconds(stamp) + 0.5) * 1024), bits.number(14)
    return (latest - (latest - residue) % 16384) / 1024.0


def seconds(stamp):
    return struct.unpack("<d", struct.pack("<Q", int(stamp.split()[0], 16)))[0]


def trajectory(reader, new_bits):
    """rink-trajectory-4."""
    bits = new_bits(reader.data[reader.at:])
    form, time, velocity, acceleration, drag = bits.number(2), 0.0, [0.0, 0.0], [0.0, 0.0], [-1.0, -1.0]
    is_driven = form == 3 and bits.number(1) == 1
    if form == 3 and not is_driven:
        bits.whole_bytes()
        reader.take(1)
        return reader.take(72)
    if form != 0:
        time = trajectory_time(bits, reader.stamp)
    position = grid_pair(bits, 24) if form == 2 else grid_pair(bits, 17, 31.0)
    if form != 0:
        velocity = grid_pair(bits, 20 if form == 2 else 14)
    if is_driven:
        along, is_short = [(0.0, 1.0, -1.0)[bits.number(2)] for _ in "xy"], bits.number(1)
    elif form == 2:
        has_acceleration, is_own = bits.number(1), [bits.number(1), bits.number(1)]
    reader.take(bits.whole_bytes())
    if is_driven:
        upper = reader.take(2)
        (size,) = struct.unpack("<f", (b"\0\0" if is_short else reader.take(2)) + upper)
        acceleration = [each * size if each else 0.0 for each in along]
    elif form == 2:
        acceleration = list(struct.unpack("<ff", reader.take(8))) if has_acceleration else acceleration
        drag = [-1.0 if own else struct.unpack("<d", reader.take(8))[0] for own in is_own]
    return struct.pack("<9d", time, *position, *velocity, *acceleration, *drag)


def held_keys(reader, _):
    """rink-input-2."""
    packed = reader.varint()
    assert packed >> 36 == 0
    return struct.pack("<IB", packed >> 4, packed & 15)


def shape(reader, _):
    """rink-shape-1."""
    kind_and_team, numbers = reader.take(2), b""
    for _ in range(6):
        first = reader.varint()
        if first == 1:
            numbers += reader.take(4)
        else:
            assert first % 2 == 0 and first >> 1 < 2**24
            numbers += struct.pack("<f", (first >> 1) / 10000)
    return kind_and_team + numbers


CODECS = {"rink-trajectory-4": trajectory, "rink-input-2": held_keys, "rink-shape-1": shape}
SHIPPED_CODECS = {"Rink": [("Trajectory", "rink-trajectory-4"), ("Input", "rink-input-2"), ("Shape", "rink-shape-1")]}


# Residuals

def warp(x):
    """(1 - exp(-x))/x, (x - 1 + exp(-x))/x^2 and exp(-x), by a series for x/256 that is doubled eight times."""
    y = x / 256
    s = 1.0 - y * (0.5 - y * (1.0 / 6.0 - y * (1.0 / 24.0)))
    q = 0.5 - y * (1.0 / 6.0 - y * (1.0 / 24.0))
    e = 1.0 - y * s
    for _ in range(8):
        s, q, e = s * (1.0 + e) * 0.5, (2.0 * q + s * s) * 0.25, e * e
    return s, q, e


def slide(t, drag, k):
    s, q, e = warp(drag * t)
    return e - k * (t * s), t * s - k * (t * t * q)


def lead(former, shape, instant):
    """Where a trajectory leads: place and velocity."""
    time, x, y, vx, vy, ax, ay, *drags = struct.unpack("<9d", former)
    own, friction = struct.unpack("<ff", shape[10:18])
    if (vx, vy, ax, ay) == (0, 0, 0, 0):
        return (x, y), (0.0, 0.0)
    t = instant - time if instant > time else 0.0
    speed = math.sqrt(vx * vx + vy * vy)
    if friction > 0 and speed > 0 and (ax, ay) == (0, 0):
        k = friction / speed
        kept, length = slide(t, own, k)
        if kept < 0:
            low, high = 0.0, t
            for _ in range(24):
                middle = 0.5 * (low + high)
                if slide(middle, own, k)[0] < 0:
                    high = middle
                else:
                    low = middle
            kept, length = 0.0, slide(low, own, k)[1]
        return (x + vx * length, y + vy * length), (vx * kept, vy * kept)
    place, velocity = [], []
    for p, v, a, drag in ((x, vx, ax, drags[0]), (y, vy, ay, drags[1])):
        s, q, e = warp((own if drag == -1 else drag) * t)
        place.append(p + v * (t * s) + a * (t * t * q))
        velocity.append(v * e + a * (t * s))
    return place, velocity


def steps(led, former):
    """In 1/2048, to even; where the lead is no reasonable number, those of the value before."""
    return [round(value * 2048) if abs(value * 2048) < 2**40 else round(before * 2048) for value, before in zip(led, former)]


def push(bits, thrust):
    along = bits.number(2)
    if along < 3:
        return (0.0, thrust, -thrust)[along]
    return struct.unpack("<f", struct.pack("<f", thrust * ((bits.number(8) - 127) / 127)))[0]


def trajectory_residual(bits, former, shape, stamp, other):
    """Of a companion `other` has the former trajectory, the shape and the trajectory of the one it follows."""
    (thrust, mass), values = struct.unpack("<ff", shape[18:]), struct.unpack("<9d", former)
    acceleration, drag, is_resting = values[5:7], values[7:], False
    if not bits.number(1):
        acceleration, drag, is_resting = (0.0, 0.0), (-1.0, -1.0), not bits.number(1)
        if not is_resting:
            acceleration = [push(bits, thrust) for _ in "xy"]
    late = 0 if is_resting or other else golomb(bits, 4)
    instant = (math.floor(seconds(stamp) * 1024) - late) / 1024
    if other:
        (its_mass,), its = struct.unpack("<f", other[1][22:]), struct.unpack("<9d", other[2])
        assert mass > 0 and its_mass > 0 and not is_resting and its[0] <= seconds(stamp)
        instant = its[0]
    place, velocity = lead(former, shape, instant)
    if other:
        lost = [led - now for led, now in zip(lead(other[0], other[1], instant)[1], its[3:5])]
        velocity = [led + its_mass / mass * each for led, each in zip(velocity, lost)]
    place = [(count + signed(golomb(bits, 1))) / 2048 for count in steps(place, values[1:3])]
    if is_resting:
        return struct.pack("<9d", 0.0, *place, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0)
    order = 1 if other else (1, 6, 9, 11)[bits.number(2)]
    velocity = [(count + signed(golomb(bits, order))) / 2048 for count in steps(velocity, values[3:5])]
    return struct.pack("<9d", instant, *place, *velocity, *acceleration, *drag)


def input_residual(bits, former, _, __, ___):
    count, held = struct.unpack("<IB", former)
    count = (count + (1 if bits.number(1) else golomb(bits, 0))) % 2**32
    held = held ^ 1 << bits.number(2) if bits.number(1) else bits.number(4)
    return struct.pack("<IB", count, held)


RESIDUALS = {"Trajectory": trajectory_residual, "Input": input_residual}


def residuals(reader, new_bits):
    number, size = reader.varint(), reader.varint()
    bits, members = new_bits(reader.take(size)), reader.model.objects[number][1]
    may = [k for k, (_, data_type) in enumerate(members) if data_type in dict(reader.model.codecs) and data_type in RESIDUALS]
    order, way_order, named, handle, lines = bits.number(4), bits.number(4), [], None, []

    def record(handle, companion):
        nonlocal named
        chosen = may[-1:]
        if not bits.number(1):
            if not bits.number(1):
                named = [k for k in may if bits.number(1)]
            chosen = named
        assert chosen
        former, values, change = reader.connection.former[handle], b"", {}
        for data_type in (members[k][1] for k in chosen):
            before = former[data_type]
            former[data_type] = RESIDUALS[data_type](bits, before, former.get("Shape"), reader.stamp, (companion or {}).get(data_type))
            change[data_type] = before, former.get("Shape"), former[data_type]
            values += former[data_type]
        names = "+".join(members[k][0] for k in chosen)
        lines.append("reflect %d %s %s %s %s" % (handle, reader.object_class(number), names, reader.stamp, values.hex()))
        return change

    while True:
        if handle is None:
            handle = golomb(bits, 0) << 18 | golomb(bits, 10)
        else:
            handle += 1 + golomb(bits, order)
        has_companion = bits.number(1)
        change = record(handle, None)
        if has_companion:
            record(handle + signed(golomb(bits, way_order) + 1), change)
        left = new_bits(bits.data)
        left.at = bits.at
        if 8 * size - bits.at < 8 and left.number(8 * size - bits.at) == 0:
            return lines


# Baselines

def golomb(bits, order):
    zeros = 0
    while bits.number(1) == 0:
        zeros += 1
    h = 1 << zeros | bits.number(zeros)
    return (h - 1) << order | bits.number(order)


def signed(number):
    return -(number + 1) // 2 if number & 1 else number // 2


def is_quantised_throughout(model, name):
    return model.size(name) is not None and all(grid is not None for _, _, grid, _ in model.fields(name))


def rates(model, name, base=0):
    """Which flat field is the rate of which: {rate: moved}."""
    declared = model.types.get(name)
    if declared is None or declared.tag != "fixedRecordData":
        return {}
    found, at, places = {}, base, {}
    for field in declared.findall("field"):
        places[field.findtext("name")] = at
        found.update(rates(model, field.findtext("dataType"), at))
        at += len(model.fields(field.findtext("dataType")))
    for field in declared.findall("field"):
        words = (model.notes.get(field.get("notes")) or "").split()
        if words[:2] == ["rate", "of"]:
            found[places[field.findtext("name")]] = places[words[2]]
    return found


def codec_lines(model, data_types):
    """The lines of the hash for those of an attribute's data types that have a quantised form."""
    lines = []
    for name in sorted(data_types):
        if model.size(name) is None or all(grid is None for _, _, grid, _ in model.fields(name)):
            continue
        text, moved = "codec %s rink-quantised-1" % name, rates(model, name)
        for number, (form, (code, size, grid, padding)) in enumerate(zip(model.forms(name), model.fields(name))):
            text += " %d%s%d" % (FORMS[form[:-2]] if grid is not None else 0, "b" if grid is not None and form.endswith("BE") else "l", size)
            if grid is not None:
                step, first, last = grid
                text += ":%d:%d:%d" % (struct.unpack("<Q", struct.pack("<d", step))[0] // 2**52 - 1023, first, last - first)
            if number in moved:
                text += "@%d" % moved[number]
            if padding:
                text += "+%d" % padding
        lines.append(text)
    return lines


class Keyframes:
    """What one federate keeps: the states of each keyframe, by number."""

    def __init__(self):
        self.states, self.open = {}, None

    def begin(self, number):
        self.open = number
        self.states[number] = {}
        return ["begin_keyframe %d" % number]

    def end_frame(self):
        self.open = None


def predicted(fields, moved, state, time):
    """The numbers of the state after the time since it was told."""
    counts, told = state
    foretold = list(counts)
    for rate, target in moved.items():
        rate_step, rate_first, _ = fields[rate][2]
        step, first, last = fields[target][2]
        steps = round((rate_first + counts[rate]) * rate_step * (time - told) / step)
        if abs(steps) < 2**50:
            foretold[target] = min(max(foretold[target] + steps, 0), last - first)
    return foretold


def deltas(reader, new_bits):
    number = reader.varint()
    name, data_type = reader.model.periodic[number]
    fields, moved = reader.model.fields(data_type), rates(reader.model, data_type)
    bits, keyframes = new_bits(reader.data[reader.at:]), reader.connection.keyframes
    baseline, orders = None, []
    if bits.number(1):
        baseline = keyframes.states[bits.number(16)]
        orders = [bits.number(5) for _ in fields]
    time = struct.unpack("<d", struct.pack("<Q", int(reader.stamp.split()[0], 16)))[0]
    lines, handle = [], 0
    while True:
        if bits.number(1):
            handle += 1
        else:
            step = golomb(bits, 4)
            if step == 0:
                break
            handle += signed(step - 1)
        counts = None
        if bits.number(1) == 0:
            counts = [foretold + signed(golomb(bits, order)) for foretold, order in zip(predicted(fields, moved, baseline[handle], time), orders)]
        elif bits.number(1) == 0:
            counts = [bits.number((last - first).bit_length()) for _, _, (_, first, last), _ in fields]
        if counts is None:
            value = b"".join(bytes(padding) + bytes(bits.number(8) for _ in range(size)) for _, size, _, padding in fields)
        else:
            assert all(0 <= count <= last - first for count, (_, _, (_, first, last), _) in zip(counts, fields)), "beyond the range"
            numbers = [(first + count) * step for count, (_, _, (step, first, _), _) in zip(counts, fields)]
            value = b"".join(bytes(padding) + struct.pack(code, number if code[1] in "fd" else int(number)) for (code, _, _, padding), number in zip(fields, numbers))
            if keyframes.open is not None:
                keyframes.states[keyframes.open][handle] = (counts, time)
        lines.append("reflect %d %s %s %s %s" % (handle, reader.object_class(number), name, reader.stamp, value.hex()))
    reader.take(bits.whole_bytes())
    return lines


# Admission

class Admission:
    """Both ends' nonces and what they prove."""

    def __init__(self, secret):
        self.key = hashlib.scrypt(secret.rstrip(b" \t\n\v\f\r"), salt=b"rink key 2", n=1 << 15, r=8, p=1, maxmem=1 << 26, dklen=32) if secret else None
        self.is_proven = False
        self.version = self.federation = self.federate = self.rti = None

    def hello(self, reader):
        self.version, self.federate, self.federation = reader.u16(), reader.take(32), reader.text()
        return ["hello version %d %s" % (self.version, self.federation)]

    def challenge(self, reader):
        self.rti = reader.take(32)
        return ["challenge"]

    def proof(self, reader, who):
        self.is_proven = reader.take(32) == self.derived(b"rink admission 2", who)
        return ["%s %s" % (("", "proof", "admitted")[who], "good" if self.is_proven else "bad")]

    def derived(self, purpose, who):
        name = self.federation.encode()
        text = purpose + bytes([who]) + struct.pack("<HB", self.version, len(name)) + self.federate + self.rti + name
        return hashlib.blake2b(text, digest_size=32, key=self.key).digest()

    def opened(self, direction, records):
        """The stream within sealed records."""
        key = self.derived(b"rink session 2", 1 if direction == "u" else 2)
        assert all(record[0] == 1 for record in records), "a frame is no record"
        return b"".join(open_sealed(key, struct.pack("<IQ", 0, number), record[1:]) for number, record in enumerate(records))


def chacha_block(key, count, nonce):
    """RFC 8439, 2.3."""
    start = list(struct.unpack("<4I8I4I", b"expand 32-byte k" + key + struct.pack("<I", count) + nonce))
    state = start[:]
    turn = lambda value, by: (value << by | value >> 32 - by) & 0xffffffff
    for _ in range(10):
        for a, b, c, d in ((0, 4, 8, 12), (1, 5, 9, 13), (2, 6, 10, 14), (3, 7, 11, 15), (0, 5, 10, 15), (1, 6, 11, 12), (2, 7, 8, 13), (3, 4, 9, 14)):
            for x, y, z, by in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
                state[x] = (state[x] + state[y]) & 0xffffffff
                state[z] = turn(state[z] ^ state[x], by)
    return struct.pack("<16I", *((a + b) & 0xffffffff for a, b in zip(start, state)))


def poly1305(key, text):
    """RFC 8439, 2.5."""
    r, s = int.from_bytes(key[:16], "little") & 0x0ffffffc0ffffffc0ffffffc0fffffff, int.from_bytes(key[16:32], "little")
    sum_ = 0
    for at in range(0, len(text), 16):
        sum_ = (sum_ + int.from_bytes(text[at:at + 16] + b"\1", "little")) * r % ((1 << 130) - 5)
    return ((sum_ + s) % (1 << 128)).to_bytes(16, "little")


def open_sealed(key, nonce, sealed):
    """RFC 8439, 2.8, without further data."""
    text, tag = sealed[:-16], sealed[-16:]
    judged = text + bytes(-len(text) % 16) + struct.pack("<QQ", 0, len(text))
    assert poly1305(chacha_block(key, 0, nonce), judged) == tag, "a record is not sealed by the key"
    stream = b"".join(chacha_block(key, 1 + block, nonce) for block in range((len(text) + 63) // 64))
    return bytes(a ^ b for a, b in zip(text, stream))


# Datagrams

class Way:
    """The datagrams of one connection: how the way opens, what comes over it, what is acknowledged."""

    def __init__(self):
        self.up_key = self.down_key = self.nonce = None
        self.steps, self.next, self.arrived, self.acknowledged, self.frames = [], {}, {}, {}, {}

    def strip(self, direction, stream):
        """What a connection with datagrams begins with; nothing of any other."""
        if len(stream) < 4 or struct.unpack_from("<I", stream)[0] != GREETING:
            return stream, None
        if direction == "u":
            return stream[4:], "greets"
        port, self.up_key, self.down_key = struct.unpack_from("<HQQ", stream, 4)
        assert port != 0
        return stream[22:], "greets back"

    def take(self, direction, datagram, is_lost, make_reader, table, frames_in_all):
        """The lines of one datagram; of one that was lost on its way nothing is said but that."""
        assert len(datagram) <= DATAGRAM_MAX
        key, kind = struct.unpack_from("<QB", datagram)
        assert key == (self.up_key if direction == "u" else self.down_key), "a stranger's"
        rest = datagram[9:]
        if kind != 0:
            return [self.step(direction, kind, rest)]
        number, frames = struct.unpack_from("<II", rest)
        assert frames <= frames_in_all, "frames that were never sent"
        assert frames >= self.frames.get(direction, 0) or number == 0
        self.frames[direction] = max(frames, self.frames.get(direction, 0))
        if number != 0:
            assert number == self.next.get(direction, 1), "numbers count from 1"
            self.next[direction] = number + 1
        if is_lost:
            return ["lost %d" % number]
        if number != 0:
            self.arrived.setdefault(direction, set()).add(number)
        lines, reader = ["data %d after %d" % (number, frames)], make_reader(rest[8:])
        while not reader.is_at_end():
            message = reader.u8()
            if message == 0:
                assert not any(reader.take(len(reader.data) - reader.at)), "padding is zeros"
            elif message == 63:
                lines.append(self.acknowledge("d" if direction == "u" else "u", reader.u32(), reader.u64()))
            else:
                assert message in (13, 19), "kind %d does not travel by datagram" % message
                lines += table[message](reader)
        return lines

    def acknowledge(self, direction, newest, before):
        """By the other end of what went in `direction`."""
        told = {newest} | {newest - 1 - k for k in range(64) if before >> k & 1}
        assert told <= self.arrived.get(direction, set()), "what never arrived is acknowledged"
        self.acknowledged.setdefault(direction, set()).update(told)
        return "acknowledge %d %d" % (newest, bin(before).count("1"))

    def step(self, direction, kind, rest):
        assert direction == ("u" if kind in (1, 3) else "d")
        name = ("", "hello", "welcome", "confirm", "open")[kind]
        if kind in (1, 2):
            assert len(rest) == DATAGRAM_MAX - 9
        if kind == 2:
            self.nonce = rest[:8]
        if kind == 3:
            assert rest == self.nonce
        assert not any(rest if kind == 1 else rest[8:] if kind == 2 else b"" if kind == 3 else rest), "zeros"
        self.steps.append(name)
        return name

    def summary(self):
        return ["%s: %d numbered, %d arrived, %d acknowledged" % ("up" if d == "u" else "down", self.next.get(d, 1) - 1, len(self.arrived.get(d, ())), len(self.acknowledged.get(d, ()))) for d in "ud"]
