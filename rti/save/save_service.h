// Saves and restores a federation execution (IEEE 1516.1-2010, 4.16 to 4.31; docs/rti.md, "Save and
// restore").
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rti/central_component.h"
#include "rti/federation/delivery/gathered_frame.h"
#include "rti/federation/federation_basis.h"
#include "rti/federation/status.h"
#include "rti/federation/time/time_service.h"
#include "rti/save/save_store.h"
#include "rti/save/saved_federation.h"
#include "rti/wire/save_messages.h"

namespace rink::rti {

/// From the notice that begins a save or a restore to the one that ends it, federates are sent
/// nothing else, so that what they know stays what the RTI knows of them; what is due to them
/// waits. Messages that were under way upwards are handled as ever, and belong to the saved state.
class SaveService {
 public:
  struct Uses {
    SavePhase& phase;
    const TimeService& time;
    SaveStore* store;  ///< null: there is nowhere to save to
  };
  /// Appends the state of the federation; false if it cannot.
  using Write = std::function<bool(std::vector<std::byte>& state)>;
  /// Prepares a federation of that state, which begins once all federates are restored; false if it
  /// cannot be read.
  using Prepare = std::function<bool(const SavedFederation& saved)>;
  SaveService(const FederationBasis& basis, const Uses& uses) : basis_(basis), uses_(uses) {}
  /// Call it once, before anything is saved.
  void keep_by(Write write, Prepare prepare) {
    write_ = std::move(write);
    prepare_ = std::move(prepare);
  }

  Status handle_request(std::uint32_t slot, Reader& reader);
  Status handle_state(std::uint32_t slot, Reader& reader);
  /// True if the federate has said that it saves or restores, and so may send nothing of the kind.
  bool forbids(std::uint32_t slot, MessageKind kind) const;
  void left(std::uint32_t slot);

  /// Begins what was requested and is due, with notices behind all else of this flush.
  void begin_due();
  /// Ends a save that all have completed. True if this flush sends what `flush` does, and nothing
  /// else.
  bool takes_flush();
  /// True while a federate may not have heard yet of what has begun, and so goes on lawfully:
  /// limits of what it may send in one flush are those of each. Without an end, who never hears of
  /// it could fill the RTI.
  bool is_early() const { return frozen_flushes_ <= early_flushes; }
  void flush(Outlet& outlet);

  /// The federates are restored, each present slot as the saved one that `mapping` gives: who asks
  /// makes the prepared federation the present one.
  bool is_restored() const { return is_restored_; }
  const std::vector<std::uint32_t>& mapping() const { return mapping_; }
  /// The first words of a federation that was prepared by the service of the former: the last
  /// pieces of what the ambassadors knew.
  void announce_restored(const SavedFederation& saved);
  /// The save from which the prepared federation is.
  const SavedFederation& saved() const { return saved_; }

 private:
  static constexpr std::uint32_t early_flushes = 128;
  struct Wish {
    std::uint32_t slot = 0;
    std::string label;
    std::optional<double> time;
  };
  struct Part {
    SaveStatus save = SaveStatus::none;
    RestoreStatus restore = RestoreStatus::none;
    std::vector<std::byte> ambassador;                     ///< its state, once it was saved
    std::size_t handed_out = 0;                            ///< of its state, to restore
    std::vector<std::byte> mail;                           ///< that is sent while nothing else is
    bool asks_for_save = false, asks_for_restore = false;  ///< how far that is
  };
  Part& part(std::uint32_t slot);
  template <class Message>
  void tell(std::uint32_t slot, Message message);
  void tell_all(const SaveNoticeMessage& notice);
  template <class Visit>
  void for_each_joined(Visit visit) const;
  void answer_queries();
  void answer_query(std::uint32_t slot, bool is_restore);
  bool is_save_due() const;
  void begin_save();
  void begin_restore();
  std::string match_federates();
  void finish_save();
  void fail_save(SaveFailure failure, std::string_view why);
  void fail_restore(RestoreFailure failure, std::string_view why);
  /// Tells all how it ended; `failure` and `why` are of the words that have them.
  void conclude(SaveNotice word, std::uint8_t failure, std::string_view why);
  void begin(SavePhase phase);
  void end();
  void fail_if_late();
  const SavedFederate& saved_of(std::uint32_t slot) const;
  void hand_out(Outlet& outlet);
  Status take_save(std::uint32_t slot, SaveWord word, std::uint32_t number);
  Status take_restore(std::uint32_t slot, SaveWord word, std::uint32_t number);

  FederationBasis basis_;
  Uses uses_;
  Write write_;
  Prepare prepare_;
  std::optional<Wish> save_, restore_;  ///< requested, and not begun
  std::string label_;                   ///< of the save under way
  std::size_t ambassador_bytes_ = 0;    ///< of its parts
  std::uint32_t number_ = 0;            ///< of the save or restore under way, or of the last
  std::vector<Part> parts_;             ///< by slot
  SavedFederation saved_;               ///< to restore
  std::vector<std::uint32_t> mapping_;  ///< by present slot
  bool is_handing_out_ = false;         ///< all have restored themselves
  bool is_restored_ = false;
  double began_at_ = 0.0;             ///< the save or restore under way [s]
  std::uint32_t frozen_flushes_ = 0;  ///< since then
  GatheredFrame frame_;
};

template <class Visit>
void SaveService::for_each_joined(Visit visit) const {
  for (std::uint32_t slot = 0; slot < basis_.federates.size(); ++slot)
    if (basis_.federates[slot].is_joined) visit(slot);
}

template <class Message>
void SaveService::tell(std::uint32_t slot, Message message) {
  if (uses_.phase != SavePhase::idle) write(part(slot).mail, message);
  else basis_.federates[slot].outbox.after_updates(message);
}

}  // namespace rink::rti
