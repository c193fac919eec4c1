// The phases of a save and of a restore.
#include "rti/save/save_service.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "rti/wire/membership_messages.h"

namespace rink::rti {

namespace {

/// Where the last piece of a state begins.
std::size_t last_piece(Bytes state) {
  constexpr std::size_t size = AmbassadorStateMessage::size_max;
  return state.empty() ? 0 : (state.size() - 1) / size * size;
}

}  // namespace

SaveService::Part& SaveService::part(std::uint32_t slot) {
  if (slot >= parts_.size()) parts_.resize(slot + std::size_t{1});
  return parts_[slot];
}

void SaveService::tell_all(const SaveNoticeMessage& notice) {
  for_each_joined([&](std::uint32_t slot) { tell(slot, notice); });
}

Status SaveService::handle_request(std::uint32_t slot, Reader& reader) {
  SaveRequestMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  const auto word = static_cast<SaveWord>(message.word);
  const bool is_idle = uses_.phase == SavePhase::idle;
  switch (word) {
    // Who asks while a save or restore is under way did not know of it yet, and is told of it.
    case SaveWord::request:
    case SaveWord::request_at_time:
      if (!is_idle) return std::nullopt;
      save_ = {slot, std::string(message.label), std::nullopt};
      if (word == SaveWord::request_at_time) save_->time = message.time;
      return std::nullopt;
    case SaveWord::request_restore:
      if (is_idle && !restore_) restore_ = {slot, std::string(message.label), std::nullopt};
      return std::nullopt;
    case SaveWord::query:
      part(slot).asks_for_save = true;
      return std::nullopt;
    case SaveWord::query_restore:
      part(slot).asks_for_restore = true;
      return std::nullopt;
    case SaveWord::abort:
      if (uses_.phase == SavePhase::saving)
        fail_save(SaveFailure::save_aborted, to_string(SaveFailure::save_aborted));
      return std::nullopt;
    case SaveWord::abort_restore:
      if (uses_.phase == SavePhase::restoring && !is_restored_)
        fail_restore(RestoreFailure::restore_aborted, to_string(RestoreFailure::restore_aborted));
      return std::nullopt;
    case SaveWord::begun:
    case SaveWord::complete:
    case SaveWord::not_complete:
      return take_save(slot, word, message.number);
    case SaveWord::restore_complete:
    case SaveWord::restore_not_complete:
      return take_restore(slot, word, message.number);
  }
  return Violation::malformed;
}

/// An answer to a save that has ended meanwhile breaks no rule.
Status SaveService::take_save(std::uint32_t slot, SaveWord word, std::uint32_t number) {
  if (uses_.phase != SavePhase::saving || number != number_) return std::nullopt;
  Part& own = part(slot);
  if (own.save != (word == SaveWord::begun ? SaveStatus::instructed : SaveStatus::saving))
    return Violation::wrong_phase;
  if (word == SaveWord::not_complete) {
    fail_save(SaveFailure::federate_reported_failure,
              "federate '" + basis_.federates[slot].name + "' could not save itself");
    return std::nullopt;
  }
  if (word == SaveWord::begun) own.ambassador.clear();
  own.save = word == SaveWord::begun ? SaveStatus::saving : SaveStatus::waiting;
  return std::nullopt;
}

Status SaveService::take_restore(std::uint32_t slot, SaveWord word, std::uint32_t number) {
  if (uses_.phase != SavePhase::restoring || number != number_ || is_handing_out_)
    return std::nullopt;
  Part& own = part(slot);
  if (own.restore != RestoreStatus::restoring) return Violation::wrong_phase;
  if (word == SaveWord::restore_not_complete) {
    fail_restore(RestoreFailure::federate_reported_failure,
                 "federate '" + basis_.federates[slot].name + "' could not restore itself");
    return std::nullopt;
  }
  own.restore = RestoreStatus::waiting;
  is_handing_out_ = true;
  for_each_joined(
      [&](std::uint32_t each) { is_handing_out_ &= part(each).restore == RestoreStatus::waiting; });
  is_restored_ = is_handing_out_;
  for_each_joined(
      [&](std::uint32_t each) { is_restored_ &= last_piece(saved_of(each).ambassador) == 0; });
  return std::nullopt;
}

Status SaveService::handle_state(std::uint32_t slot, Reader& reader) {
  AmbassadorStateMessage message;
  if (!exchange(reader, message)) return Violation::malformed;
  Part& own = part(slot);
  if (uses_.phase != SavePhase::saving || own.save != SaveStatus::saving) return std::nullopt;
  if (own.ambassador.size() + message.piece.size() > AmbassadorStateMessage::state_max)
    return Violation::over_limit;
  ambassador_bytes_ += message.piece.size();
  if (ambassador_bytes_ > basis_.settings.save_bytes_max) {
    fail_save(SaveFailure::rti_unable_to_save, "more than " +
                                                   std::to_string(basis_.settings.save_bytes_max) +
                                                   " bytes for all ambassadors");
    return std::nullopt;
  }
  const std::size_t windows = own.ambassador.size() / AmbassadorStateMessage::window;
  own.ambassador.insert(own.ambassador.end(), message.piece.begin(), message.piece.end());
  if (own.ambassador.size() / AmbassadorStateMessage::window != windows) {
    SaveNoticeMessage notice;
    notice.notice = static_cast<std::uint8_t>(SaveNotice::go_on);
    notice.number = number_;
    tell(slot, notice);
  }
  return std::nullopt;
}

bool SaveService::forbids(std::uint32_t slot, MessageKind kind) const {
  if (uses_.phase == SavePhase::idle || slot >= parts_.size()) return false;
  const bool has_answered = parts_[slot].save == SaveStatus::saving ||
                            parts_[slot].save == SaveStatus::waiting ||
                            parts_[slot].restore == RestoreStatus::waiting;
  if (!has_answered) return false;
  constexpr MessageKind allowed[] = {MessageKind::heartbeat,
                                     MessageKind::resign_directive,
                                     MessageKind::resign,
                                     MessageKind::query_management,
                                     MessageKind::notify_host,
                                     MessageKind::save_request,
                                     MessageKind::ambassador_state,
                                     MessageKind::refuse_keyframe,
                                     MessageKind::acknowledge_keyframe};
  return std::ranges::find(allowed, kind) == std::end(allowed);
}

void SaveService::left(std::uint32_t slot) {
  if (slot < parts_.size()) parts_[slot] = {};
  if (restore_ && restore_->slot == slot) restore_.reset();
  const std::string why = "federate '" + basis_.federates[slot].name + "' left";
  if (uses_.phase == SavePhase::saving) fail_save(SaveFailure::federate_resigned, why);
  if (uses_.phase == SavePhase::restoring) fail_restore(RestoreFailure::federate_resigned, why);
}

/// A save at a time waits until every constrained federate has been granted that time.
bool SaveService::is_save_due() const {
  if (!save_) return false;
  const TimeManagement* const management = uses_.time.management();
  bool is_due = true;
  if (save_->time && management != nullptr)
    for_each_joined([&](std::uint32_t slot) {
      is_due &= !management->is_constrained(slot) || management->time(slot) >= *save_->time;
    });
  return is_due;
}

void SaveService::begin_due() {
  if (uses_.phase != SavePhase::idle) return;
  answer_queries();
  if (restore_) begin_restore();
  else if (is_save_due()) begin_save();
}

void SaveService::begin_save() {
  const Wish wish = *std::exchange(save_, std::nullopt);
  label_ = wish.label;
  SaveNoticeMessage notice;
  notice.number = ++number_;
  if (uses_.store == nullptr) {
    notice.notice = static_cast<std::uint8_t>(SaveNotice::not_saved);
    notice.text = "this RTI has no directory to save to";
    notice.failure = static_cast<std::uint8_t>(SaveFailure::rti_unable_to_save);
    if (basis_.federates[wish.slot].is_joined) tell(wish.slot, notice);
    return;
  }
  notice.notice =
      static_cast<std::uint8_t>(wish.time ? SaveNotice::initiate_at_time : SaveNotice::initiate);
  notice.text = label_;
  notice.time = wish.time.value_or(0.0);
  tell_all(notice);
  for_each_joined([&](std::uint32_t slot) { part(slot).save = SaveStatus::instructed; });
  begin(SavePhase::saving);
}

void SaveService::begin_restore() {
  const Wish wish = *std::exchange(restore_, std::nullopt);
  SaveNoticeMessage notice;
  notice.number = ++number_;
  std::string why = "this RTI has no directory to restore from";
  if (uses_.store != nullptr) {
    const SaveStore::Found found = uses_.store->read(basis_.settings.federation, wish.label);
    saved_ = {};
    why = found.bytes ? decode(*found.bytes, saved_) : found.why;
    if (why.empty()) why = match_federates();
    if (why.empty() && !prepare_(saved_)) why = "it is damaged: its state cannot be read";
  }
  notice.notice = static_cast<std::uint8_t>(why.empty() ? SaveNotice::restore_confirmed
                                                        : SaveNotice::restore_refused);
  notice.text = wish.label;
  notice.name = std::string_view(why).substr(0, text_max);
  tell(wish.slot, notice);
  if (!why.empty()) {
    saved_ = {};
    return;
  }
  notice.notice = static_cast<std::uint8_t>(SaveNotice::restore_begun);
  notice.text = {};
  tell_all(notice);
  notice.notice = static_cast<std::uint8_t>(SaveNotice::initiate_restore);
  notice.text = wish.label;
  for_each_joined([&](std::uint32_t slot) {
    const auto saved = std::ranges::find(saved_.federates, mapping_[slot], &SavedFederate::slot);
    notice.name = saved->name;
    notice.federate = saved->handle.value;
    tell(slot, notice);
    part(slot).restore = RestoreStatus::restoring;
  });
  begin(SavePhase::restoring);
}

void SaveService::begin(SavePhase phase) {
  uses_.phase = phase;
  began_at_ = basis_.now;
  frozen_flushes_ = 0;
}

/// Names who is waited for: it is alive, or it would have left.
void SaveService::fail_if_late() {
  if (basis_.now - began_at_ <= basis_.settings.save_s_max) return;
  std::string why;
  for_each_joined([&](std::uint32_t slot) {
    const bool is_done = uses_.phase == SavePhase::saving
                             ? part(slot).save == SaveStatus::waiting
                             : part(slot).restore == RestoreStatus::waiting &&
                                   (!is_handing_out_ ||
                                    part(slot).handed_out >= last_piece(saved_of(slot).ambassador));
    if (!is_done && why.empty())
      why = "federate '" + basis_.federates[slot].name + "' took too long";
  });
  if (why.empty()) return;
  if (uses_.phase == SavePhase::saving) fail_save(SaveFailure::rti_detected_failure, why);
  else fail_restore(RestoreFailure::rti_detected_failure, why);
}

bool SaveService::takes_flush() {
  if (uses_.phase != SavePhase::idle) {
    answer_queries();
    ++frozen_flushes_;
    if (!is_restored_) fail_if_late();
  }
  if (uses_.phase == SavePhase::saving) {
    bool is_complete = true;
    for_each_joined(
        [&](std::uint32_t slot) { is_complete &= part(slot).save == SaveStatus::waiting; });
    if (is_complete) finish_save();
  }
  return uses_.phase != SavePhase::idle ||
         std::ranges::any_of(parts_, [](const Part& each) { return !each.mail.empty(); });
}

void SaveService::finish_save() {
  SavedFederation saved;
  saved.federation = basis_.settings.federation;
  saved.label = label_;
  saved.fom_hash = basis_.fom.hash();
  for_each_joined([&](std::uint32_t slot) {
    const JoinedFederate& federate = basis_.federates[slot];
    saved.federates.push_back({slot, federate.handle, federate.name, federate.type,
                               std::exchange(part(slot).ambassador, {})});
  });
  if (!write_(saved.state))
    return fail_save(SaveFailure::rti_unable_to_save,
                     "a part of the RTI was replaced by one that cannot be saved");
  const std::string why = uses_.store->write(saved.federation, saved.label, encoded(saved));
  if (!why.empty()) return fail_save(SaveFailure::rti_detected_failure, why);
  conclude(SaveNotice::saved, 0, {});
}

void SaveService::fail_save(SaveFailure failure, std::string_view why) {
  conclude(SaveNotice::not_saved, static_cast<std::uint8_t>(failure), why);
}

void SaveService::fail_restore(RestoreFailure failure, std::string_view why) {
  conclude(SaveNotice::not_restored, static_cast<std::uint8_t>(failure), why);
}

void SaveService::conclude(SaveNotice word, std::uint8_t failure, std::string_view why) {
  SaveNoticeMessage notice;
  notice.notice = static_cast<std::uint8_t>(word);
  notice.number = number_;
  notice.text = why.substr(0, text_max);
  notice.failure = failure;
  tell_all(notice);
  end();
}

void SaveService::end() {
  uses_.phase = SavePhase::idle;
  is_handing_out_ = is_restored_ = false;
  frozen_flushes_ = 0;
  ambassador_bytes_ = 0;
  saved_ = {};
  for (Part& each : parts_) {
    each.save = SaveStatus::none;
    each.restore = RestoreStatus::none;
    each.ambassador = {};
    each.handed_out = 0;
  }
}

/// The saved federates are in the order of their slots.
const SavedFederate& SaveService::saved_of(std::uint32_t slot) const {
  return *std::ranges::lower_bound(saved_.federates, mapping_[slot], {}, &SavedFederate::slot);
}

/// Whose queue does not empty keeps the former federation, and nobody is restored before all can
/// be.
void SaveService::hand_out(Outlet& outlet) {
  is_restored_ = true;
  for_each_joined([&](std::uint32_t slot) {
    const SavedFederate& saved = saved_of(slot);
    std::size_t& done = part(slot).handed_out;
    constexpr std::size_t size = AmbassadorStateMessage::size_max;
    std::size_t waiting = outlet.waiting_bytes(basis_.federates[slot].connection);
    for (; done < last_piece(saved.ambassador) && waiting < AmbassadorStateMessage::window;
         done += size, waiting += size) {
      const Bytes piece = Bytes(saved.ambassador).subspan(done, size);
      tell(slot, RestoredMessage{saved.handle.value, 0, 0, piece});
    }
    is_restored_ &= done >= last_piece(saved.ambassador);
  });
}

void SaveService::announce_restored(const SavedFederation& saved) {
  for (const SavedFederate& each : saved.federates) {
    const Bytes state = each.ambassador;
    RestoredMessage message{each.handle.value, 1, basis_.federates[each.slot].block,
                            state.subspan(last_piece(state))};
    write(part(each.slot).mail, message);
  }
}

void SaveService::flush(Outlet& outlet) {
  if (is_handing_out_) hand_out(outlet);
  for_each_joined([&](std::uint32_t slot) {
    JoinedFederate& federate = basis_.federates[slot];
    Part& own = part(slot);
    const bool is_silent = basis_.now - federate.last_sent >= basis_.settings.timeouts.heartbeat_s;
    if (own.mail.empty() && !is_silent) return;
    frame_.begin(federate.stamp_steps);
    frame_.append(own.mail);
    if (own.mail.empty()) frame_.enqueue(HeartbeatMessage{});
    own.mail.clear();
    const std::size_t size = frame_.sent_size();
    federate.last_sent = basis_.now;
    basis_.counters.bytes_sent += size;
    federate.counts.bytes_received += size;
    ++basis_.counters.frames_sent;
    ++federate.frames;
    outlet.send(federate.connection, frame_.finish());
  });
}

}  // namespace rink::rti
