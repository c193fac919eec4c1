"""Reads a recorded conversation with the RTI by docs/wire.md alone, and prints each message as one line. Python's standard library only.

    second_reader.py MODEL.xml SESSION [KEY]
    second_reader.py MODEL.xml SESSION --sizes


SESSION is a sequence of records: 'u' (from the federate) or 'd' (from the RTI), connection u32, length u32, bytes; 'U' and 'D' for UDP datagrams, 'X' and 'Y' for those
that were lost on their way. The lines of one connection and direction stand together, in the order in which they were sent; then those of datagrams in theirs. Whatever the
page does not explain ends the program with an error: every byte is accounted for. --sizes prints only how many bytes the messages of each kind take in each direction,
kind 0 being the heads of frames. KEY is the key file of a session that begins with the admission.
"""
import math
import struct
import sys
import xml.etree.ElementTree as ElementTree

import second_reader_exact as exact
import second_reader_parts as parts

ALL_ONES = 0xFFFFFFFF
BASIC_SIZES = {"HLAbyte": 1, "HLAASCIIchar": 1, "HLAoctet": 1, "HLAoctetPairLE": 2, "HLAoctetPairBE": 2, "HLAunicodeChar": 2, "HLAboolean": 4,
               "HLAinteger16LE": 2, "HLAinteger16BE": 2, "HLAinteger32LE": 4, "HLAinteger32BE": 4, "HLAinteger64LE": 8, "HLAinteger64BE": 8,
               "HLAfloat32LE": 4, "HLAfloat32BE": 4, "HLAfloat64LE": 8, "HLAfloat64BE": 8}
NUMBER_FORMS = {"HLAinteger16": "h", "HLAinteger32": "i", "HLAfloat32": "f", "HLAfloat64": "d"}


class Model:
    """The object model: classes as they stand in the file, outer before inner, and how values of their types travel."""

    def __init__(self, path):
        root = ElementTree.parse(path).getroot()
        for element in root.iter():
            element.tag = element.tag.split("}")[-1]
        self.codecs = parts.SHIPPED_CODECS.get(root.findtext("modelIdentification/name"), [])
        self.switches = parts.switches(root)
        self.types = {}
        for kind in root.iter("dataTypes"):
            for group in kind:
                for declared in group:
                    self.types[declared.findtext("name")] = declared
        self.notes = {note.findtext("label"): note.findtext("semantics") for note in root.iter("note")}
        self.dimensions = [(each.findtext("name"), int(each.findtext("upperBound") or 0)) for outer in root.iter("dimensions") for each in outer.findall("dimension") if len(each)]
        self.objects, self.interactions = [], []
        self.periodic = []  # by object class: the attribute that is told by baselines, and its type
        self.object_lines, self.interaction_lines, self.root = [], [], root
        for outer in root.iter("objects"):
            self.add(outer, "objectClass", "attribute", self.objects, [], self.object_lines, [], ALL_ONES)
        for outer in root.iter("interactions"):
            self.add(outer, "interactionClass", "parameter", self.interactions, [], self.interaction_lines, [], ALL_ONES)

    def add(self, outer, tag, member, into, inherited, lines, inherited_lines, parent):
        for element in outer.findall(tag):
            members = inherited + [(each.findtext("name"), each.findtext("dataType")) for each in element.findall(member)]
            of_class = inherited_lines + [line for each in element.findall(member) for line in self.member_lines(each, member == "attribute")]
            number = len(into)
            if member == "attribute":
                periodic = self.periodic[parent] if parent != ALL_ONES else None
                for each in element.findall(member):
                    if periodic is None and each.findtext("updateType") == "Periodic" and parts.is_quantised_throughout(self, each.findtext("dataType")):
                        periodic = (each.findtext("name"), each.findtext("dataType"))
                self.periodic.append(periodic)
            into.append((element.findtext("name"), members))
            own = [] if member == "attribute" else self.travel_lines(element)
            lines.append(["%s %s" % ("object" if member == "attribute" else "interaction", element.findtext("name")), str(parent)] + own + of_class)
            self.add(element, tag, member, into, members, lines, of_class, number)

    def travel_lines(self, element):
        """Transportation, order and dimensions as numbers."""
        bits = sum(1 << [name for name, _ in self.dimensions].index(each.text) for each in element.findall("dimensions/dimension"))
        if element.findtext("name") == "HLAinteractionRoot":
            return ["0", "0", str(bits)]
        return [str(int(element.findtext("transportation") == "HLAbestEffort")), str(int(element.findtext("order") == "TimeStamp")), str(bits)]

    def member_lines(self, element, is_attribute):
        size = self.size(element.findtext("dataType"))
        lines = [element.findtext("name"), element.findtext("dataType"), str(ALL_ONES if size is None else size)]
        return lines + (self.travel_lines(element) if is_attribute else [])

    def hash(self):
        lines = [line for each in self.object_lines + self.interaction_lines for line in each]
        for name, upper in self.dimensions:
            lines += ["dimension " + name, str(upper)]
        lines += parts.codec_lines(self, {data_type for _, members in self.objects for _, data_type in members})
        lines += ["baselines %s %s" % (name, periodic[0]) for (name, _), periodic in zip(self.objects, self.periodic) if periodic is not None]
        lines += ["switches " + self.switches] if self.switches else []
        lines += ["codec %s %s" % codec for codec in self.codecs]
        return parts.fnv1a("".join(line + "\n" for line in lines), 64)

    def size(self, name):
        """Bytes of a value; None if that varies."""
        if name in BASIC_SIZES:
            return BASIC_SIZES[name]
        declared = self.types.get(name)
        if declared is None:
            return None
        if declared.tag == "basicData":
            return int(declared.findtext("size")) // 8
        if declared.findtext("representation"):
            return self.size(declared.findtext("representation"))
        if declared.tag == "arrayData":
            count, element, encoding = declared.findtext("cardinality"), self.size(declared.findtext("dataType")), parts.encoding(declared, "HLAfixedArray")
            if not (count and count.isdigit()) or element is None:
                return None
            boundary = self.boundary(declared.findtext("dataType")) if encoding in ("HLAfixedArray", "HLAvariableArray") else 1
            at = 4 if encoding == "HLAvariableArray" else 0
            for _ in range(int(count)):
                at += -at % boundary + element
            return at
        if declared.tag == "fixedRecordData":
            sizes = [self.size(field.findtext("dataType")) for field in declared.findall("field")]
            return None if None in sizes else sum(sizes) + sum(self.paddings(declared))
        return None

    def boundary(self, name):
        """The octet boundary value of a type of fixed size."""
        declared = self.types.get(name)
        if declared is not None and declared.findtext("representation"):
            return self.boundary(declared.findtext("representation"))
        if declared is not None and declared.tag == "arrayData":
            least = 4 if parts.encoding(declared, "HLAfixedArray") == "HLAvariableArray" else 1
            return max(least, self.boundary(declared.findtext("dataType")))
        if declared is not None and declared.tag == "fixedRecordData":
            return max([self.boundary(field.findtext("dataType")) for field in declared.findall("field")], default=1)
        return 1 << (self.size(name) - 1).bit_length()

    def paddings(self, record):
        """Bytes before each field of a record."""
        paddings, at = [], 0
        for field in record.findall("field"):
            name = field.findtext("dataType")
            paddings.append(-at % self.boundary(name) if parts.encoding(record, "HLAfixedRecord") == "HLAfixedRecord" else 0)
            at += paddings[-1] + self.size(name)
        return paddings

    def fields(self, name):
        """Records laid flat: (struct format or None, size, grid, padding) of each field; grid is (step, first k, last k) or None, padding the bytes before it."""
        declared = self.types.get(name)
        if declared is not None and declared.tag == "fixedRecordData":
            flat = []
            for field, padding in zip(declared.findall("field"), self.paddings(declared)):
                inner = self.fields(field.findtext("dataType"))
                flat += [inner[0][:3] + (inner[0][3] + padding,)] + inner[1:]
            return flat
        form = declared.findtext("representation") if declared is not None and declared.findtext("representation") else name
        number, order = form[:-2], form[-2:]
        code = {"LE": "<", "BE": ">"}.get(order, "<") + NUMBER_FORMS[number] if number in NUMBER_FORMS else None
        return [(code, self.size(name), self.grid(declared) if declared is not None and declared.tag == "simpleData" else None, 0)]

    def forms(self, name):
        """The representation of each field."""
        declared = self.types.get(name)
        if declared is not None and declared.tag == "fixedRecordData":
            return [part for field in declared.findall("field") for part in self.forms(field.findtext("dataType"))]
        return [declared.findtext("representation") if declared is not None and declared.findtext("representation") else name]

    def grid(self, declared):
        words = (self.notes.get(declared.get("notes")) or "").split()
        resolution = declared.findtext("resolution")
        if len(words) != 3 or words[0] != "range" or resolution is None:
            return None
        step = 2.0 ** math.floor(math.log2(float(resolution)))  # at most twice the error, which is half the resolution
        return step, math.floor(float(words[1]) / step), math.ceil(float(words[2]) / step)


class Bits:
    """Least significant first."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def number(self, count):
        value = 0
        for i in range(count):
            value |= (self.data[self.at // 8] >> self.at % 8 & 1) << i
            self.at += 1
        return value

    def whole_bytes(self):
        while self.at % 8:
            assert self.number(1) == 0, "what fills the last byte up is zeros"
        return self.at // 8


class Reader:
    def __init__(self, data, model, connection=None):
        self.data, self.at, self.model, self.stamp, self.connection = data, 0, model, None, connection

    def is_at_end(self):
        return self.at == len(self.data)

    def take(self, count):
        part = self.data[self.at:self.at + count]
        assert len(part) == count, "a message is cut short"
        self.at += count
        return part

    def u8(self):
        return self.take(1)[0]

    def u16(self):
        return struct.unpack("<H", self.take(2))[0]

    def u32(self):
        return struct.unpack("<I", self.take(4))[0]

    def u64(self):
        return struct.unpack("<Q", self.take(8))[0]

    def f64(self):
        return "%016x" % self.u64()

    def varint(self):
        value = shift = 0
        while True:
            byte = self.u8()
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def text(self):
        return self.take(self.u8()).decode("utf-8") or "-"

    def short_bytes(self):
        return self.take(self.u16()).hex() or "-"

    def handles(self):
        return ",".join(str(self.u32()) for _ in range(self.u16())) or "-"

    def one_or_none(self):
        value = self.u32()
        return "-" if value == ALL_ONES else str(value)

    def object_class(self, number):
        return self.model.objects[number][0]

    def interaction_class(self):
        return self.model.interactions[self.u16()][0]

    def attributes(self, number, bits):
        members = self.model.objects[number][1]
        assert bits >> len(members) == 0, "an attribute that the class has not"
        return "+".join(members[k][0] for k in range(len(members)) if bits >> k & 1) or "-"

    def read_stamp(self):
        sizes = self.u8()
        time_size, tag_size = sizes & 15, sizes >> 4
        assert time_size <= 8 and tag_size <= 8
        time = bytes(8 - time_size) + self.take(time_size)
        tag = self.take(tag_size) + bytes(8 - tag_size)
        return "%016x %d" % (struct.unpack("<Q", time)[0], struct.unpack("<Q", tag)[0])

    def value(self, name):
        """As it lies in memory, decoded if it travels in a form of its own."""
        size = self.model.size(name)
        codec = dict(self.model.codecs).get(name)
        if codec is not None:
            return parts.CODECS[codec](self, Bits)
        if size is None:
            length = self.take(4)
            return length + self.take(struct.unpack("<I", length)[0])
        fields = self.model.fields(name)
        if all(grid is None for _, _, grid, _ in fields):
            return self.take(size)
        bits = Bits(self.data[self.at:])
        is_full, value = bits.number(1), b""
        for code, field_size, grid, padding in fields:
            value += bytes(padding)
            if is_full or grid is None:
                value += bytes(bits.number(8) for _ in range(field_size))
                continue
            step, first, last = grid
            k = bits.number((last - first).bit_length())
            assert k <= last - first, "beyond the range"
            number = (first + k) * step
            value += struct.pack(code, number if code[1] in "fd" else int(number))
        self.take(bits.whole_bytes())
        return value

    def updates(self, verb):
        assert self.stamp is not None, "a block of updates before the first stamp of its frame"
        number, bits = self.varint(), self.attribute_bits()
        types = [data_type for k, (_, data_type) in enumerate(self.model.objects[number][1]) if bits >> k & 1]
        lines = []
        for handle in self.block():
            each_value = [self.value(each) for each in types]
            values = b"".join(each_value)
            if verb == "reflect" and self.connection is not None:
                self.connection.former.setdefault(handle, {}).update(zip(types, each_value))
            lines.append("%s %d %s %s %s %s" % (verb, handle, self.object_class(number), self.attributes(number, bits), self.stamp, values.hex()))
        return lines

    def entries(self, is_again):
        """Objects that come into scope with their values."""
        assert self.stamp is not None, "a block of entries before the first stamp of its frame"
        if not is_again:
            head = self.varint()
            self.connection.entry_header = head >> 1, self.attribute_bits(), self.attribute_bits(), self.attribute_bits() if head & 1 else None
            assert self.connection.entry_header[3] != 0, "none that is recalled"
        number, bits, repeated, recalled = self.connection.entry_header
        recalled = recalled or 0
        assert bits != 0 and (repeated | recalled) & ~bits == 0 and repeated & recalled == 0
        last = self.connection.entry_values.setdefault(number, {})
        lines, handle, is_last = [], 1 << 18, False
        while not is_last:
            entry = self.varint()
            is_last, form = entry & 1, entry >> 1 & 3
            assert form < 3
            handle += parts.signed(entry >> 3)
            former, values = self.connection.former.setdefault(handle, {}), b""
            for k, (_, data_type) in enumerate(self.model.objects[number][1]):
                if not bits >> k & 1:
                    continue
                if form != 2:
                    former[data_type] = self.entry_value(data_type, last.setdefault(k, []), repeated >> k & 1, recalled >> k & 1)
                values += former[data_type]
            if form == 1:
                lines.append("discover %d %s -" % (handle, self.object_class(number)))
            lines.append("in_scope %d" % handle)
            lines.append("reflect %d %s %s %s %s" % (handle, self.object_class(number), self.attributes(number, bits), self.stamp, values.hex()))
        return lines

    def entry_value(self, data_type, kept, is_repeated, is_recalled):
        """One that follows, or of those that entries brought last."""
        if is_repeated:
            return kept[0]
        if is_recalled:
            number = self.u8()
            assert number > 0, "the last one is repeated"
            kept.insert(0, kept.pop(number))
            return kept[0]
        before, value = self.at, self.value(data_type)
        if self.at - before <= 256:
            kept[:] = [value] + kept[:3]
        return value

    def block(self, before_first=0):
        """The handles of a block's objects, as the steps between them lead."""
        handle = before_first
        while True:
            step = self.varint()
            if step == 0:
                return
            handle += parts.signed(step - 1)
            yield handle

    def attribute_bits(self):
        low = self.varint()
        return low & (1 << 63) - 1 | self.varint() << 63 if low >> 63 else low

    def attribute_word(self):
        word = self.u32()
        return word & 0x7FFFFFFF | self.attribute_bits() << 32 if word >> 31 else word

    def class_and_attributes(self):
        number, bits = self.u16(), self.attribute_word()
        return self.object_class(number) + " " + self.attributes(number, bits)

    def object_message(self):
        return "%d %s %s" % (self.varint(), self.object_class(self.varint()), self.text())

    def interaction(self, verb):
        return ["%s %s %s %s %s" % (verb, self.interaction_class(), self.one_or_none(), self.read_stamp(), self.short_bytes())]

    def set_stamp(self):
        self.stamp = self.read_stamp()
        return []

    def step_stamp(self):
        last = self.connection.last_stamp
        first = self.varint()
        if first & 1:
            count, time, tag = 1, parts.signed(first >> 1), 0
        else:
            count, time, tag = first >> 1, parts.signed(self.varint()), parts.signed(self.varint())
        ahead = last[0] if count == 0 else last[0] + count * last[2]
        reached = struct.unpack("<d", struct.pack("<Q", (struct.unpack("<Q", struct.pack("<d", ahead))[0] + time) % 2**64))[0]
        assert math.isfinite(reached)
        if count == 0:
            last[2:] = reached - last[0], tag
        last[0], last[1] = reached, (last[1] + count * last[3] + tag) % 2**64
        self.stamp = "%s %d" % (struct.pack(">d", reached).hex(), last[1])
        return []

    def regions(self):
        return ["bounds %d %s %s %s %s" % (self.u32(), self.f64(), self.f64(), self.f64(), self.f64()) for _ in range(self.u16())]

    def object_block(self, verb, words):
        """A header that holds for each of the objects after it."""
        return ["%s %d %s" % (verb, handle, words) for handle in self.block()]

    def ownership(self, names):
        word, bits, tag = names[self.u8()], self.attribute_bits(), self.short_bytes()
        return self.object_block(word, "%x %s" % (bits, tag))

    def pair(self):
        attributes, place = self.u32(), self.u32()
        return attributes << 32 * (place >> 18), place & (1 << 18) - 1

    def pairs(self):
        return ",".join("%x:%d" % self.pair() for _ in range(self.u16())) or "-"

    def ranges(self):
        return ["ranges %d %s" % (self.u32(), " ".join("%s..%s" % (self.f64(), self.f64()) for _ in range(self.u8())))]

    def timed(self, table, head):
        """A whole message inside one in time-stamp order, whose stamp holds."""
        stamp = self.read_stamp()
        content = Reader(self.take(self.u16()), self.model)
        content.stamp = stamp
        kind = content.u8()
        assert kind in (12, 13, 14, 71), "kind %d does not travel in time-stamp order" % kind
        lines = table[kind](content)
        assert content.is_at_end() and len(lines) == 1, "one message, and all of it"
        return ["%s %s %s" % (head, stamp, lines[0])]

    def report(self):
        return ["report %s %s %s objects %d drops %s" % (self.text(), self.text(), self.text(), self.varint(), sum(self.varint() for _ in range(32)))]

    def federate_report(self):
        line = "federate %d %s %s" % (self.u32(), self.text(), self.text())
        self.counts = [self.varint() for _ in range(10)]
        line += " updates %d reflections %d sent %d received %d owned %d" % (tuple(self.counts[:4]) + (self.counts[7],))
        regulating, constrained, time = self.u8(), self.u8(), self.f64()
        self.take(16)  # the least stamp and the silence
        return ["%s time %d %d %s" % (line, regulating, constrained, time)]

    def join(self):
        assert self.u32() == 0x4B4E4952
        version, hash_of_model = self.u16(), self.u64()
        whose = "model" if hash_of_model == self.model.hash() else "another model, for the page's hash of this one is %016x:" % self.model.hash()
        return ["join version %d %s %016x %s %s %s" % (version, whose, hash_of_model, self.text(), self.text(), self.text())]

    def digest(self):
        told = [(self.u32(), self.u32()) for _ in range(self.u16())]
        return ["digest of %d elements of %s model" % (len(told), "this" if told == parts.digest(self.model) else "another")]

    def save_request(self):
        word = SAVE_WORDS[self.u8()]
        label = " " + self.text() if word.startswith("request") else ""
        time = " " + self.f64() if word == "request_at_time" else ""
        return ["save %s%s%s %d" % (word, label, time, self.varint())]

    def restored(self):
        federate, is_last = self.u32(), self.u8()
        block = self.u32() if is_last else 0
        return ["restored %d %d %d %d" % (federate, is_last, block, len(self.take(self.u16())))]

    def save_notice(self):
        notice = SAVE_NOTICES[self.u8()]
        line = "save_notice %s %d %s" % (notice, self.varint(), self.text())
        if notice == "initiate_at_time":
            line += " " + self.f64()
        if notice.startswith("not_"):
            line += " %d" % self.u8()
        if notice == "restore_refused":
            line += " " + self.text()
        if notice == "initiate_restore":
            line += " %s %d" % (self.text(), self.u32())
        return [line]

    def passive(self):
        return ("active", "passive")[self.u8()]

    def bits(self):
        return "{0:b}".format(self.attribute_bits())

    def names(self):
        inner = Reader(self.take(self.u16()), self.model)
        names = []
        while not inner.is_at_end():
            names.append(inner.text())
        assert names and "-" not in names, "a set of names that is empty, or an empty name"
        return ",".join(names)

    def object_attributes(self, verb):
        return ["%s %d %s" % (verb, self.varint(), self.bits())]

    def class_relevance(self):
        if self.u8() == 1:
            return ["interaction_relevance %s %d %d" % (self.model.interactions[self.varint()][0], self.varint(), self.varint())]
        number = self.varint()
        return ["class_relevance %s %s %s" % (self.object_class(number), self.attributes(number, self.attribute_bits()), self.attributes(number, self.attribute_bits()))]

    def host_message(self):
        """Those of the shipped model's host are of the policy "exact"."""
        content = self.take(self.varint())
        return self.connection.exact.read(content, Bits) if self.model.codecs else ["host_message " + content.hex()]

    def execution(self):
        if self.u8() == 1:
            return ["execution list ends"]
        return ["execution %s %s %d" % (self.text(), self.text(), self.u32())]


UP = {
    1: Reader.join,
    2: lambda r: ["resign"],
    3: lambda r: [],
    4: lambda r: ["register_synchronization_point %s %s %s" % (r.text(), r.short_bytes(), r.handles())],
    5: lambda r: ["synchronization_point_achieved %s %d" % (r.text(), r.u8())],
    6: lambda r: ["watch_federates"],
    7: lambda r: ["publish " + r.class_and_attributes()],
    8: lambda r: ["subscribe %s %s %s" % (r.class_and_attributes(), r.one_or_none(), r.passive())],
    9: lambda r: ["publish_interaction %s %d" % (r.interaction_class(), r.u8())],
    10: lambda r: ["subscribe_interaction %s %d" % (r.interaction_class(), r.u8())],
    11: lambda r: ["register " + r.object_message()],
    12: lambda r: ["delete %d" % r.varint()],
    13: lambda r: r.updates("update"),
    14: lambda r: r.interaction("send"),
    15: lambda r: ["create_region %d" % r.u32()],
    16: Reader.regions,
    17: lambda r: ["associate %d %s" % (r.u32(), r.one_or_none())],
    18: lambda r: ["delete_region %d" % r.u32()],
    19: Reader.set_stamp,
    20: lambda r: ["create_execution %s %016x" % (r.text(), r.u64())],
    21: lambda r: ["destroy_execution " + r.text()],
    22: lambda r: ["list_executions"],
    39: lambda r: ["request_update %s %d %s %s" % (("object", "class")[r.u8()], r.varint(), r.bits(), r.short_bytes())],
    40: lambda r: ["change_transportation %s %d %s %d" % (("object", "interaction")[r.u8()], r.varint(), r.bits(), r.u8())],
    41: lambda r: ["query_transportation %s %d %d" % (("object", "interaction")[r.u8()], r.varint(), r.varint())],
    46: lambda r: ["names %s %s" % (("reserve", "reserve_set", "release")[r.u8()], r.names())],
    47: lambda r: r.object_attributes("spare"),
    48: lambda r: ["local_delete %d" % r.varint()],
    49: lambda r: ["attribute_relevance_advisory %d" % r.u8()],
    23: lambda r: ["query_management"],
    24: Reader.save_request,
    25: lambda r: ["ambassador_state %d" % len(r.take(r.u16()))],
    28: lambda r: ["enable_time_regulation " + r.f64()],
    29: lambda r: [("enable_time_constrained", "disable_time_constrained", "disable_time_regulation")[r.u8()]],
    30: lambda r: ["modify_lookahead " + r.f64()],
    31: lambda r: ["%s %s" % (ADVANCES[r.u8()], r.f64())],
    32: lambda r: r.timed(UP, "timed %d" % r.varint()),
    33: lambda r: ["retract %d" % r.varint()],
    34: lambda r: ["query_time_bounds"],
    36: lambda r: r.ownership(OWNERSHIP_REQUESTS),
    37: lambda r: ["query_ownership %d %d" % (r.varint(), r.u8())],
    38: lambda r: ["resign_action %d" % r.u8()],
    58: lambda r: r.connection.admission.hello(r),
    59: lambda r: r.connection.admission.proof(r, 1),
    50: lambda r: ["acknowledge_keyframe %d" % r.u16()],
    51: lambda r: ["refuse_keyframe %d" % r.u16()],
    52: lambda r: ["create_region_over %d %x" % (r.u32(), r.u64())],
    53: Reader.ranges,
    54: lambda r: ["%s %s %s" % (r.object_class(r.u16()), ("unsubscribe", "subscribe", "request", "subscribe_passively")[r.u8()], r.pairs())],
    55: lambda r: ["subscribe_interaction_within %s %d %s" % (r.interaction_class(), r.u8(), r.handles())],
    56: lambda r: ["associate_regions %d %d %s" % (r.u32(), r.u8(), r.pairs())],
    60: lambda r: ["notify_host"],
    57: lambda r: ["send_within %s %s %s %s" % (r.interaction_class(), r.read_stamp(), r.handles(), r.short_bytes())],
}
ADVANCES = ("time_advance_request", "time_advance_request_available", "next_message_request", "next_message_request_available", "flush_queue_request")
SAVE_WORDS = ("request", "request_at_time", "begun", "complete", "not_complete", "abort", "query", "request_restore", "restore_complete", "restore_not_complete",
              "abort_restore", "query_restore")
SAVE_NOTICES = ("initiate", "initiate_at_time", "saved", "not_saved", "restore_confirmed", "restore_refused", "restore_begun", "initiate_restore", "not_restored", "go_on")
OWNERSHIP_REQUESTS = ("divest", "offer", "confirm", "deny_release", "give_if_wanted", "withdraw_offer", "acquire", "acquire_if_available", "cancel_acquisition")
OWNERSHIP_NOTICES = ("assumption_requested", "confirmation_requested", "acquired", "unavailable", "release_requested", "acquisition_cancelled", "divested", "kept", "kept_offered")
DOWN = {
    3: lambda r: [],
    13: lambda r: r.updates("reflect"),
    14: lambda r: r.interaction("receive"),
    19: Reader.set_stamp,
    64: lambda r: ["joined %d %d" % (r.u32(), r.u32())],
    120: lambda r: ["expelled " + r.text()],
    121: lambda r: ["further_block %d" % r.u32()],
    122: Reader.host_message,
    65: lambda r: ["refused %d %s" % (r.u8(), r.text())],
    66: lambda r: ["announced %s %s" % (r.text(), r.short_bytes())],
    67: lambda r: ["synchronized %s %s" % (r.text(), r.handles())],
    68: lambda r: ["federate_joined %d %s %s" % (r.u32(), r.text(), r.text())],
    69: lambda r: ["federate_resigned %d %d %s %s" % (r.u32(), r.u8(), r.text(), r.text())],
    70: lambda r: ["discover " + r.object_message()],
    71: lambda r: ["remove %d" % r.varint()],
    72: lambda r: ["in_scope %d" % each for each in r.block(1 << 18)],
    73: lambda r: ["out_of_scope %d" % each for each in r.block(1 << 18)],
    74: lambda r: ["registered %s %d" % (r.text(), r.u8())],
    75: lambda r: ["execution_created %s %d" % (r.text(), r.u8())],
    76: lambda r: ["execution_destroyed %s %d" % (r.text(), r.u8())],
    77: Reader.execution,
    104: lambda r: ["names %s %s" % (("granted", "set_granted", "refused", "set_refused", "registration_refused")[r.u8()], r.names())],
    105: Reader.class_relevance,
    106: lambda r: r.object_attributes("object_relevance"),
    78: Reader.report,
    79: Reader.federate_report,
    80: lambda r: ["report ends"],
    81: Reader.save_notice,
    123: lambda r: [r.restored()],
    124: lambda r: ["save_status %d %s" % (r.u8(), " ".join("%d:%d:%d" % (r.u32(), r.u32(), r.u8()) for _ in range(r.u16())))],
    82: lambda r: ["time_regulation_enabled %s %s" % (r.f64(), r.f64())],
    83: lambda r: ["time_constrained_enabled " + r.f64()],
    84: lambda r: ["time_advance_grant " + r.f64()],
    85: lambda r: r.timed(DOWN, "timed %d %d %d" % (r.varint(), r.u8(), r.varint())),
    86: lambda r: ["request_retraction %d %d %s" % (r.varint(), r.varint(), r.f64())],
    87: lambda r: ["time_bounds %s %s" % (r.f64(), r.f64())],
    92: lambda r: r.ownership(OWNERSHIP_NOTICES),
    93: lambda r: ["owner %d %d %s" % (r.varint(), r.u8(), r.one_or_none())],
    110: lambda r: r.connection.keyframes.begin(r.u16()),
    111: lambda r: parts.deltas(r, Bits),
    114: lambda r: parts.residuals(r, Bits),
    115: Reader.step_stamp,
    116: lambda r: r.entries(False),
    117: lambda r: r.entries(True),
    118: lambda r: r.connection.admission.challenge(r),
    119: lambda r: r.connection.admission.proof(r, 2),
    112: Reader.digest,
    107: lambda r: ["transportation %s %s %d %d %d" % (("object", "interaction")[r.u8()], ("answer", "confirmation")[r.u8()], r.varint(), r.varint(), r.u8())],
    113: lambda r: ["provide %d %s %s" % (r.varint(), r.bits(), r.short_bytes())],
}


class Connection:
    """What one connection's messages refer to."""

    def __init__(self, secret):
        self.keyframes, self.admission, self.way = parts.Keyframes(), parts.Admission(secret), parts.Way()
        self.frames, self.exact = {"u": 0, "d": 0}, exact.ExactConversation()
        self.last_stamp = [0.0, 0, 0.0, 0]  # time, tag, and a step of each
        self.entry_header = None  # class, attributes, repeated and recalled ones of the last block of entries
        self.entry_values = {}  # by class and attribute: the values that entries brought last, the newest first
        self.former = {}  # by object: the value of each data type that came last by the stream


def records_of(session):
    at = 0
    while at < len(session):
        connection, length = struct.unpack_from("<II", session, at + 1)
        yield chr(session[at]), connection, session[at + 9:at + 9 + length]
        at += 9 + length


def raw_frames_of(stream):
    at = 0
    while at < len(stream):
        low, high = (int.from_bytes(stream[k:k + 2], "little") for k in (at, at + 2))
        is_older = bytes(stream[at + 2:at + 4]) == bytes(2)
        head = 4 if is_older or low >> 15 else 2
        length = low if is_older or head == 2 else low & 32767 | high << 15
        frame = bytes(stream[at + head:at + head + length])
        assert 0 < length == len(frame), "a frame is empty or cut short"
        yield is_older, frame
        at += head + length


def frames_of(stream, direction, admission=None):
    """Those after a proof that is good are within sealed records."""
    has_joined, raw = False, raw_frames_of(stream)
    for is_older, frame in raw:
        if direction == "u":
            assert is_older != has_joined, "the older form is that of frames up to the join's"
            has_joined |= frame[0] == 1
        else:
            assert not is_older or frame[0] in (65, 112, 118, 119, 120) or 74 < frame[0] < 81, "the older form of a frame that any version need not read"
        yield frame
        if frame[0] in (59, 119) and admission and admission.is_proven:
            yield from frames_of(admission.opened(direction, [record for _, record in raw]), direction)


def read_frame(frame, model, connection, direction, sizes=None):
    reader, lines = Reader(frame, model, connection), []
    table = UP if direction == "u" else DOWN
    while not reader.is_at_end():
        start, kind = reader.at, reader.u8()
        assert kind in table, "kind %d of direction %s is not in docs/wire.md" % (kind, direction)
        lines += table[kind](reader)
        if sizes is not None:
            sizes[direction, kind] = sizes.get((direction, kind), 0) + reader.at - start
    connection.keyframes.end_frame()
    return lines


def main(model_path, session_path, key_path=None):
    sizes = {} if key_path == "--sizes" else None
    model, secret = Model(model_path), open(key_path, "rb").read() if key_path and sizes is None else None
    with open(session_path, "rb") as file:
        records = list(records_of(file.read()))
    streams, connections = {}, {}
    for direction, connection, data in records:
        connections.setdefault(connection, Connection(secret))
        if direction in "ud":
            streams.setdefault((connection, direction), bytearray()).extend(data)
    for (number, direction), stream in sorted(streams.items()):
        stream, greeting = connections[number].way.strip(direction, stream)
        streams[number, direction] = stream
        if greeting:
            print("%d%s %s" % (number, direction, greeting))
        first = next(frames_of(stream, direction), b"")
        if first[:1] in (b"\x3a", b"\x76"):  # hello and challenge: each proof is about both
            read_frame(first, model, connections[number], direction)
    for (number, direction), stream in sorted(streams.items()):
        connection = connections[number]
        for frame in frames_of(stream, direction, connection.admission):
            is_counted = connection.frames[direction] > 0 or frame[0] in (1, 64)  # from the one that asks to join, or lets in, on
            connection.frames[direction] += is_counted
            for line in read_frame(frame, model, connection, direction, sizes):
                if sizes is None:
                    print("%d%s %s" % (number, direction, line))
            if sizes is not None:
                sizes[direction, 0] = sizes.get((direction, 0), 0) - len(frame)
        if sizes is not None:
            sizes[direction, 0] += len(stream)
    for (direction, kind), size in sorted((sizes or {}).items()):
        print("size %s %d %d" % (direction, kind, size))
    for letter, number, data in records:
        if letter in "UDXY":
            connection, direction = connections[number], "u" if letter in "UX" else "d"
            make_reader = lambda rest: Reader(rest, model, connection)
            for line in connection.way.take(direction, data, letter in "XY", make_reader, UP if direction == "u" else DOWN, connection.frames[direction]):
                print("%d%s %s" % (number, letter, line))
    for number, connection in sorted(connections.items()):
        if connection.way.up_key is not None:
            assert connection.way.steps[-1:] == ["open"] and {"hello", "welcome", "confirm"} <= set(connection.way.steps), "how the way opens"
            for line in connection.way.summary():
                print("%d %s" % (number, line))


if __name__ == "__main__":
    main(*sys.argv[1:])
