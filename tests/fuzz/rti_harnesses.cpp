// The readers of the RTI: whole federations, frames, blocks of updates, bits, object models and
// federation files.
#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "rti/admission/handshake.h"
#include "rti/federation_directory.h"
#include "rti/federation_file.h"
#include "rti/wire/bit_stream.h"
#include "rti/wire/frame.h"
#include "rti/wire/update_block.h"
#include "tests/fuzz/federation_scene.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/service_scene.h"
#include "tests/rti/rig.h"
#include "tests/rti/scenes/fjord.h"

namespace rink::fuzz {
namespace {

using namespace rti;

/// A stream cut anywhere gives the frames that it gives in one piece.
void frames(Bytes bytes) {
  const auto frames_of = [](Bytes stream, std::size_t step) {
    FrameReader reader;
    std::vector<std::byte> heard;
    bool is_sound = true;
    for (std::size_t at = 0; at < stream.size() && is_sound; at += step) {
      const Bytes piece = stream.subspan(at, std::min(step, stream.size() - at));
      const Framing framing = reader.receive(
          piece, [] { return std::size_t{1000}; },
          [&heard](Bytes frame) {
            require(!frame.empty() && frame.size() <= 1000, "frames have their size");
            heard.insert(heard.end(), frame.begin(), frame.end());
            heard.push_back(std::byte{'|'});
            return true;
          });
      is_sound = framing == Framing::sound;
      require(reader.waiting_bytes() <= 1004, "no more than a frame is kept");
    }
    return heard;
  };
  Input input(bytes);
  const std::size_t step = 1 + input.byte() % 16;
  const Bytes stream = input.rest();
  require(frames_of(stream, step) == frames_of(stream, stream.size() + 1), "cuts change nothing");
}

/// Zeros are empty frames and 0xff an oversized one, once the frame at hand is complete.
void refuse_frames(Bytes bytes) {
  for (const unsigned value : {0x00u, 0xffu}) {
    FrameReader reader;
    const auto receive = [&reader](Bytes part) {
      return reader.receive(
          part, [] { return std::size_t{1000}; }, [](Bytes) { return true; });
    };
    if (receive(bytes) != Framing::sound) continue;
    const std::vector<std::byte> noise(1000 + 2 * frame_head_max, static_cast<std::byte>(value));
    require(receive(noise) != Framing::sound, "a stream of frames that cannot be is refused");
  }
}

/// A stranger may send in full what would be rounded, so a value may change when it is coded, but
/// not when it is coded again.
void require_stable(const ObjectClass& object_class, AttributeSet set, Bytes values) {
  std::vector<std::byte> coded, rounded, again, stable;
  encode(object_class, set, values, 0.0, coded);
  require(coded_size(object_class, set, coded) == coded.size(), "a coded value ends by itself");
  require(decode(object_class, set, coded, 0.0, rounded), "what was coded is decoded");
  encode(object_class, set, rounded, 0.0, again);
  require(decode(object_class, set, again, 0.0, stable) && stable == rounded,
          "what was rounded keeps its value");
}

/// What a block gives, written again, is read as the same.
void update_blocks(Bytes bytes) {
  Input input(bytes);
  const auto& classes = rti::testing::fjord().object_classes();
  const ObjectClass& object_class = classes[input.byte() % classes.size()];
  const AttributeSet set(input.byte() & ((1u << object_class.attributes.size()) - 1u));
  if (set.is_empty()) return;
  struct Record {
    std::uint32_t object;
    std::vector<std::byte> values;
    bool operator==(const Record&) const = default;
  };
  const auto records_of = [&](Bytes block, std::vector<Record>& records) {
    Reader reader(block);
    return read_records(reader, object_class, set, [&](auto object, Bytes values) {
      std::uint32_t handle = 0;
      static_assert(sizeof object == sizeof handle);
      std::memcpy(&handle, &object, sizeof handle);
      records.push_back({handle, {values.begin(), values.end()}});
      std::vector<std::byte> decoded;
      if (decode(object_class, set, values, 0.0, decoded))
        require_stable(object_class, set, decoded);
      return true;
    });
  };
  std::vector<Record> records, again;
  if (!records_of(input.rest(), records)) return;
  std::vector<std::byte> block;
  {
    RecordWriter writer(block);
    for (const Record& record : records) writer.add(record.object, record.values);
  }
  require(records_of(block, again) && again == records,
          "a block that is written again is the same");
}

/// The first bytes of a block are no block.
void refuse_update_blocks(Bytes bytes) {
  const ObjectClass& object_class = rti::testing::harbour().at(rti::testing::vessel);
  std::vector<std::byte> block, value(sizeof(float));
  const Bytes given = bytes.first(std::min(bytes.size(), value.size()));
  std::ranges::copy(given, value.begin());
  {
    RecordWriter writer(block);
    for (const std::uint32_t object : {3u, 70u, 100'000u}) writer.add(object, value);
  }
  for (std::size_t size = 0; size < block.size(); ++size) {
    Reader reader(Bytes(block).first(size));
    require(!read_records(reader, object_class, AttributeSet{rti::testing::speed},
                          [](auto, Bytes) { return true; }),
            "a block that is cut off is refused");
  }
}

/// Whether `parse` turns `text` away with a complaint.
template <class Error, class Parse>
bool is_turned_away(const Parse& parse, const std::string& text) {
  try {
    parse(text);
    return false;
  } catch (const Error&) {
    return true;
  }
}

void refuse_object_models(Bytes bytes) {
  const auto parse = [](const std::string& text) { Fom::parse(text, "fuzzed.xml"); };
  require(is_turned_away<FileError>(parse, text_of(bytes) + "<"),
          "a model that breaks off is refused");
}

void refuse_federation_files(Bytes bytes) {
  const auto parse = [](const std::string& text) { parse_federation_file(text, "fuzzed.toml"); };
  require(is_turned_away<FileError>(parse, text_of(bytes) + "\n]=[\n"),
          "what is no TOML is refused");
}

void object_models(Bytes bytes) {
  try {
    const Fom fom = Fom::parse(text_of(bytes), "fuzzed.xml");
    fom.hash();
  } catch (const FileError& error) {
    require(std::strncmp(error.what(), "fuzzed.xml", 10) == 0, "a complaint names the file");
  }
}

void federation_files(Bytes bytes) {
  try {
    const FederationFile file = parse_federation_file(text_of(bytes), "fuzzed.toml");
    require(!file.nodes.empty(), "a federation has a node");
    require(file.nodes.front().port > 0 && !file.nodes.front().address.empty(),
            "the node that is asked has an address and a port");
    for (const Node& node : file.nodes)
      require((node.port > 0) == !node.address.empty(), "a node that asks has both or neither");
  } catch (const FileError& error) {
    require(std::strncmp(error.what(), "fuzzed.toml", 11) == 0, "a complaint names the file");
  }
}

/// Says nothing, and notes who is dropped.
struct Silent final : Outlet {
  void send(ConnectionId, std::span<const Bytes>) override {}
  void drop(ConnectionId connection, std::string_view) override {
    is_connected[connection] = false;
  }
  std::array<bool, 4> is_connected{};
};

void converse(FederationDirectory& directory, Silent& outlet, Bytes bytes) {
  directory.offer(rti::testing::harbour());
  require(directory.create("rink", rti::testing::harbour().hash()) == HlaError::none,
          "the first name is free");
  Input input(bytes);
  while (!input.is_empty()) {
    const unsigned what = input.byte();
    const ConnectionId who = what % 4;
    if (!outlet.is_connected[who]) directory.connect(who);
    outlet.is_connected[who] = true;
    if (what / 4 % 4 == 3) {
      directory.match();
      directory.flush(outlet);
    } else {
      directory.receive(who, input.part(input.byte()));
    }
  }
}

/// Conversations with a host of many federations.
void directories(Bytes bytes) {
  FederationDirectory directory;
  Silent outlet;
  converse(directory, outlet, bytes);
  require(directory.find("rink") != nullptr || directory.list().size() <= 1024,
          "no more executions than allowed");
}

/// More zeros than the longest frame has bytes: whatever frame was begun is complete, and an empty
/// one follows it.
const std::vector<std::byte>& endless_zeros() {
  static const std::vector<std::byte> zeros(frame_max_to_rti + 2 * frame_head_max);
  return zeros;
}

void refuse_directories(Bytes bytes) {
  FederationDirectory directory;
  Silent outlet;
  converse(directory, outlet, bytes);
  for (ConnectionId who = 0; who < outlet.is_connected.size(); ++who) {
    if (!outlet.is_connected[who]) directory.connect(who);
    outlet.is_connected[who] = true;
    directory.receive(who, endless_zeros());
    directory.match();
    directory.flush(outlet);
    require(!outlet.is_connected[who], "whoever sends frames without messages is dropped");
  }
}

void refuse_handshakes(Bytes bytes) {
  static const SharedKey key(std::as_bytes(std::span("a key that is long enough")));
  for (const Role role : {Role::rti, Role::federate}) {
    Handshake handshake(key, role, "rink", Nonce{});
    Bytes left = bytes;
    handshake.receive(left);
    left = endless_zeros();
    handshake.receive(left);
    require(handshake.state() == Handshake::State::failed,
            "a handshake of frames without messages fails");
  }
}

/// Either end of a handshake with somebody who has not the key.
void handshakes(Bytes bytes) {
  static const SharedKey key(std::as_bytes(std::span("a key that is long enough")));
  Input input(bytes);
  const Role role = input.byte() % 2 == 0 ? Role::rti : Role::federate;
  Handshake handshake(key, role, "rink", Nonce{});
  std::size_t heard = 0, said = 0;
  while (!input.is_empty()) {
    const Bytes part = input.part(1 + input.byte() % 64);
    Bytes left = part;
    heard += part.size();
    const bool had_failed = handshake.state() == Handshake::State::failed;
    handshake.receive(left);
    require(handshake.state() != Handshake::State::proven, "nobody proves a key that he has not");
    require(!had_failed || handshake.state() == Handshake::State::failed, "a failure is final");
    said += handshake.outgoing().size();
    handshake.clear_outgoing();
    require(role == Role::federate || said <= heard, "a stranger is told no more than he said");
  }
}

}  // namespace

std::span<const Harness> rti_harnesses() {
  static constexpr std::array<Harness, 13> list{
      {{"federation", drive_federation, refuse_federation},
       {"federate", drive_federate, refuse_federate},
       {"datagrams", drive_datagrams, refuse_datagrams},
       {"time", drive_time, refuse_time},
       {"ownership", drive_ownership, refuse_ownership},
       {"regions", drive_regions, refuse_regions},
       {"baselines", drive_baselines, refuse_baselines},
       {"handshake", handshakes, refuse_handshakes},
       {"directory", directories, refuse_directories},
       {"frames", frames, refuse_frames},
       {"update_block", update_blocks, refuse_update_blocks},
       {"object_model", object_models, refuse_object_models},
       {"federation_file", federation_files, refuse_federation_files}}};
  return list;
}

}  // namespace rink::fuzz
