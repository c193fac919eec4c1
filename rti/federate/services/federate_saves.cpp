// Follows a save or a restore at its federate's side.
#include "rti/federate/services/federate_saves.h"

#include <algorithm>
#include <utility>

#include "rti/federate/books/require.h"

namespace rink::rti {

void FederateSaves::refuse_busy() const {
  if (activity_ == Activity::saving)
    throw RtiException(HlaError::save_in_progress, "wait until the federation is saved");
  throw RtiException(HlaError::restore_in_progress, "wait until the federation is restored");
}

void FederateSaves::require_not(Activity activity) const {
  basis_.phase.require_joined();
  if (activity_ == activity) refuse_busy();
}

void FederateSaves::say(SaveWord word, std::string_view label, double time) {
  basis_.frames.enqueue(SaveRequestMessage{static_cast<std::uint8_t>(word), label, time, number_});
}

void FederateSaves::request(std::string_view label, std::optional<LogicalTime> time) {
  basis_.phase.require_joined();
  require_idle();
  require_text(label, "the save's label");
  if (!time) return say(SaveWord::request, label);
  if (!uses_.time.clock().is_regulating())
    throw RtiException(HlaError::federate_unable_to_use_time,
                       "a federate that does not regulate time cannot name one");
  if (time->value < uses_.time.clock().time())
    throw RtiException(HlaError::logical_time_already_passed,
                       "a save begins at a time that the federate has not passed");
  say(SaveWord::request_at_time, label, time->value);
}

bool FederateSaves::is_late(Activity activity, Step step) {
  if (activity_ != Activity::none || ended_ != activity || ended_step_ != step) return false;
  ended_step_ = step == Step::asked && activity == Activity::saving ? Step::begun : Step::answered;
  return true;
}

void FederateSaves::end() {
  ended_ = std::exchange(activity_, Activity::none);
  ended_step_ = std::exchange(step_, Step::none);
  outgoing_ = incoming_ = {};
  sent_ = 0;
}

void FederateSaves::begun() {
  require_not(Activity::restoring);
  if (is_late(Activity::saving, Step::asked)) return;
  if (activity_ != Activity::saving || step_ != Step::asked)
    throw RtiException(HlaError::save_not_initiated, "no save waits for this federate to begin");
  step_ = Step::begun;
  say(SaveWord::begun);
}

void FederateSaves::complete(bool is_success) {
  require_not(Activity::restoring);
  if (is_late(Activity::saving, Step::begun)) return;
  if (activity_ != Activity::saving || step_ != Step::begun)
    throw RtiException(HlaError::federate_has_not_begun_save, "federate_save_begun comes first");
  step_ = Step::answered;
  if (!is_success) return say(SaveWord::not_complete);
  outgoing_.clear();
  sent_ = 0;
  write_(outgoing_);
  send_state();
}

void FederateSaves::send_state() {
  const Bytes window = Bytes(outgoing_).subspan(sent_).first(
      std::min(outgoing_.size() - sent_, AmbassadorStateMessage::window));
  for (Bytes left = window; !left.empty();) {
    const Bytes piece = left.first(std::min(left.size(), AmbassadorStateMessage::size_max));
    basis_.frames.enqueue(AmbassadorStateMessage{piece});
    left = left.subspan(piece.size());
  }
  sent_ += window.size();
  if (sent_ < outgoing_.size()) return;
  outgoing_ = {};
  sent_ = 0;
  say(SaveWord::complete);
}

void FederateSaves::abort() {
  require_not(Activity::restoring);
  if (activity_ != Activity::saving)
    throw RtiException(HlaError::save_not_in_progress, "there is no save to abort");
  say(SaveWord::abort);
}

void FederateSaves::query() {
  require_not(Activity::restoring);
  say(SaveWord::query);
}

void FederateSaves::request_restore(std::string_view label) {
  basis_.phase.require_joined();
  require_idle();
  require_text(label, "the save's label");
  say(SaveWord::request_restore, label);
}

void FederateSaves::complete_restore(bool is_success) {
  require_not(Activity::saving);
  if (is_late(Activity::restoring, Step::asked)) return;
  if (activity_ != Activity::restoring || step_ != Step::asked)
    throw RtiException(HlaError::restore_not_requested,
                       "no restore waits for this federate to complete");
  step_ = Step::answered;
  say(is_success ? SaveWord::restore_complete : SaveWord::restore_not_complete);
}

void FederateSaves::abort_restore() {
  require_not(Activity::saving);
  if (activity_ != Activity::restoring)
    throw RtiException(HlaError::restore_not_in_progress, "there is no restore to abort");
  say(SaveWord::abort_restore);
}

void FederateSaves::query_restore() {
  require_not(Activity::saving);
  say(SaveWord::query_restore);
}

/// Values that were kept back, or sent by datagrams that may be lost, go to the RTI now: what it
/// saves must have them, and what it restores must not be overwritten by them.
void FederateSaves::settle() {
  uses_.sparing.release_all();
  uses_.sender.release_all();
}

bool FederateSaves::handle_notice(Reader& reader) {
  SaveNoticeMessage message;
  if (!exchange(reader, message)) return false;
  switch (static_cast<SaveNotice>(message.notice)) {
    case SaveNotice::initiate:
    case SaveNotice::initiate_at_time:
      if (activity_ != Activity::none) return false;
      settle();
      activity_ = Activity::saving;
      step_ = Step::asked;
      number_ = message.number;
      break;
    case SaveNotice::initiate_restore:
      if (activity_ != Activity::none) return false;
      settle();
      activity_ = Activity::restoring;
      step_ = Step::asked;
      number_ = message.number;
      break;
    case SaveNotice::saved:
    case SaveNotice::not_saved:
    case SaveNotice::not_restored:
      end();
      break;
    case SaveNotice::restore_confirmed:
    case SaveNotice::restore_refused:
    case SaveNotice::restore_begun:
      break;
    case SaveNotice::go_on:
      if (sent_ < outgoing_.size()) send_state();
      return true;
  }
  call_back(message);
  return true;
}

void FederateSaves::call_back(const SaveNoticeMessage& message) {
  FederateAmbassador& federate = basis_.callbacks;
  switch (static_cast<SaveNotice>(message.notice)) {
    case SaveNotice::initiate:
      return federate.initiate_federate_save(message.text);
    case SaveNotice::initiate_at_time:
      return federate.initiate_federate_save_with_time(message.text, LogicalTime(message.time));
    case SaveNotice::saved:
      return federate.federation_saved();
    case SaveNotice::not_saved:
      return federate.federation_not_saved(static_cast<SaveFailure>(message.failure), message.text);
    case SaveNotice::restore_confirmed:
      return federate.request_federation_restore_succeeded(message.text);
    case SaveNotice::restore_refused:
      return federate.request_federation_restore_failed(message.text, message.name);
    case SaveNotice::restore_begun:
      return federate.federation_restore_begun();
    case SaveNotice::initiate_restore:
      return federate.initiate_federate_restore(message.text, message.name, {message.federate});
    case SaveNotice::not_restored:
      return federate.federation_not_restored(static_cast<RestoreFailure>(message.failure),
                                              message.text);
    case SaveNotice::go_on:
      return;
  }
}

bool FederateSaves::handle_status(Reader& reader) {
  SaveStatusMessage message;
  if (!exchange(reader, message)) return false;
  Reader records(message.records);
  std::vector<FederateSaveStatus> saves;
  std::vector<FederateRestoreStatus> restores;
  saves.reserve(message.count);
  restores.reserve(message.count);
  while (!records.is_at_end()) {
    SaveStatusRecord each;
    if (!exchange(records, each)) return false;
    if (message.is_restore == 0 && each.status > static_cast<std::uint8_t>(SaveStatus::waiting))
      return false;
    saves.push_back({{each.before}, static_cast<SaveStatus>(each.status)});
    restores.push_back({{each.before}, {each.after}, static_cast<RestoreStatus>(each.status)});
  }
  if (message.is_restore != 0) basis_.callbacks.federation_restore_status_response(restores);
  else basis_.callbacks.federation_save_status_response(saves);
  return true;
}

bool FederateSaves::handle_restored(Reader& reader) {
  RestoredMessage message;
  if (!exchange(reader, message) || activity_ != Activity::restoring ||
      incoming_.size() + message.piece.size() > AmbassadorStateMessage::state_max)
    return false;
  incoming_.insert(incoming_.end(), message.piece.begin(), message.piece.end());
  if (message.is_last == 0) return true;
  uses_.sender.keep_time();
  if (!read_(incoming_, message.block)) return false;
  uses_.session.restored({message.federate});
  end();
  was_restored_ = true;
  basis_.callbacks.federation_restored();
  return true;
}

}  // namespace rink::rti
