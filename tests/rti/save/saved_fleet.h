// A federation that can be saved, whose federates save and restore themselves as they are told to.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rti/save/save_store.h"
#include "tests/rti/errors.h"
#include "tests/rti/rig.h"

namespace rink::rti::testing {

/// Saves in memory; `fault` is why it cannot write.
class MemoryStore final : public SaveStore {
 public:
  std::map<std::string, std::vector<std::byte>, std::less<>> saves;  ///< by label
  std::string fault;

  std::string write(std::string_view, std::string_view label, Bytes bytes) override {
    if (fault.empty()) saves[std::string(label)].assign(bytes.begin(), bytes.end());
    return fault;
  }
  Found read(std::string_view, std::string_view label) override {
    const auto found = saves.find(label);
    if (found == saves.end()) return {std::nullopt, "there is none"};
    return {found->second, {}};
  }
};

/// Like a federate's own program it keeps what it knows when it saves, and takes it back when it
/// restores.
class Keeper final : public Recorder {
 public:
  enum class Answer : std::uint8_t { complete, begun_only, not_complete, nothing };
  Ambassador* ambassador = nullptr;
  Answer save_answer = Answer::complete, restore_answer = Answer::complete;
  std::vector<std::string> told;
  std::map<std::string, decltype(Recorder::objects), std::less<>> kept;  ///< by label

  void initiate_federate_save(std::string_view label) override {
    told.push_back("save " + std::string(label));
    save(label);
  }
  void initiate_federate_save_with_time(std::string_view label, LogicalTime time) override {
    told.push_back("save " + std::string(label) + " at " + std::to_string(time.value));
    save(label);
  }
  void federation_saved() override { told.push_back("saved"); }
  void federation_not_saved(SaveFailure failure, std::string_view why) override {
    told.push_back("not saved: " + std::string(to_string(failure)) + "; " + std::string(why));
  }
  void federation_save_status_response(std::span<const FederateSaveStatus> all) override {
    save_status.assign(all.begin(), all.end());
  }
  void request_federation_restore_succeeded(std::string_view label) override {
    told.push_back("confirmed " + std::string(label));
  }
  void request_federation_restore_failed(std::string_view label, std::string_view why) override {
    told.push_back("refused " + std::string(label) + ": " + std::string(why));
  }
  void federation_restore_begun() override { told.push_back("restore begun"); }
  void initiate_federate_restore(std::string_view label, std::string_view name,
                                 FederateHandle handle) override {
    told.push_back("restore " + std::string(label) + " as " + std::string(name));
    restored_handle = handle;
    const auto found = kept.find(label);
    before = objects;
    if (found != kept.end()) objects = found->second;
    if (restore_answer == Answer::complete) ambassador->federate_restore_complete();
    if (restore_answer == Answer::not_complete) ambassador->federate_restore_not_complete();
  }
  void federation_restored() override { told.push_back("restored"); }
  void federation_not_restored(RestoreFailure failure, std::string_view why) override {
    told.push_back("not restored: " + std::string(to_string(failure)) + "; " + std::string(why));
    objects = before;
  }
  void federation_restore_status_response(std::span<const FederateRestoreStatus> all) override {
    restore_status.assign(all.begin(), all.end());
  }
  void time_advance_grant(LogicalTime time) override { granted = time.value; }
  void time_bounds(double bound, double) override { galt = bound; }
  void reflect_attribute_values_with_time(ObjectHandle object, AttributeSet attributes,
                                          Bytes values, const TimedStamp& timed) override {
    told.push_back("at " + std::to_string(timed.stamp.time));
    reflect_attribute_values(object, attributes, values, timed.stamp);
  }

  std::vector<FederateSaveStatus> save_status;
  std::vector<FederateRestoreStatus> restore_status;
  FederateHandle restored_handle;
  double granted = 0.0;
  std::optional<double> galt;

 private:
  void save(std::string_view label) {
    kept[std::string(label)] = objects;
    if (save_answer == Answer::nothing) return;
    ambassador->federate_save_begun();
    if (save_answer == Answer::begun_only) return;
    if (save_answer == Answer::complete) ambassador->federate_save_complete();
    else ambassador->federate_save_not_complete();
  }
  decltype(Recorder::objects) before;
};

class SavedFleet : private Outlet {
 public:
  struct Member {
    Keeper heard;
    std::unique_ptr<Ambassador> ambassador;
    std::string dropped;
  };
  std::shared_ptr<MemoryStore> store = std::make_shared<MemoryStore>();
  std::deque<Member> members;
  std::string record;               ///< of the conversation, for the second reader
  FederationSettings settings;      ///< of the federation that begins next
  bool has_damaged_states = false;  ///< in its saves: who is sent one may refuse it
  std::size_t most_at_once = 0;     ///< bytes to or from one federate in one round
  const Fom* model = &harbour();

  SavedFleet() { begin(); }
  /// The RTI begins anew, as another process, and knows the saves alone; so do the federates, who
  /// have their own files.
  void begin(bool has_store = true) {
    std::map<std::string, decltype(Keeper::kept)> files;
    for (std::size_t i = 0; i < members.size(); ++i) files[names_[i]] = members[i].heard.kept;
    files_ = std::move(files);
    members.clear();
    names_.clear();
    settings.filter = "region";
    FederationServices services;
    if (has_store) services.save_store = store;
    execution_ = std::make_unique<FederationExecution>(*model, settings, services);
  }
  FederationExecution& execution() { return *execution_; }

  Member& join(const std::string& name, const std::string& type = "sailor",
               CallbackModel callbacks = CallbackModel::immediate) {
    Member& member = members.emplace_back();
    member.ambassador = std::make_unique<Ambassador>(*model, member.heard, Timeouts{}, callbacks);
    member.heard.ambassador = member.ambassador.get();
    member.heard.kept = files_[name];
    names_.push_back(name);
    execution_->connect(static_cast<ConnectionId>(members.size() - 1));
    member.ambassador->join("rink", name, type);
    tick();
    return member;
  }
  /// Four rounds: a request, its notice, the answers and the end.
  void tick(int rounds = 4) {
    for (int round = 0; round < rounds; ++round) {
      receive();
      execution_->match();
      execution_->flush(*this);
      for (Member& each : members) each.ambassador->advance_clock(0.0);
    }
  }
  void receive() {
    for (ConnectionId id = 0; id < members.size(); ++id) {
      if (!members[id].dropped.empty()) continue;
      note('u', id, members[id].ambassador->outgoing());
      most_at_once = std::max(most_at_once, members[id].ambassador->outgoing().size());
      execution_->receive(id, members[id].ambassador->outgoing());
      members[id].ambassador->clear_outgoing();
    }
  }
  void lose(std::size_t member) {
    execution_->disconnect(static_cast<ConnectionId>(member), "lost");
    members[member].dropped = "lost";
  }
  std::vector<std::string> told(Member& member) {
    tick();
    return std::exchange(member.heard.told, {});
  }

 private:
  void note(char direction, ConnectionId id, Bytes bytes) {
    if (bytes.empty()) return;
    record += direction;
    record += text_of(values_of(id, static_cast<std::uint32_t>(bytes.size()))) + text_of(bytes);
  }
  void send(ConnectionId id, std::span<const Bytes> parts) override {
    std::size_t size = 0;
    for (const Bytes part : parts) {
      most_at_once = std::max(most_at_once, size += part.size());
      note('d', id, part);
      const bool is_taken = members[id].ambassador->receive(part);
      EXPECT_TRUE(is_taken || has_damaged_states);
      if (!is_taken) members[id].dropped = "it did not take what it was sent";
    }
  }
  void drop(ConnectionId id, std::string_view why) override { members[id].dropped = why; }

  std::unique_ptr<FederationExecution> execution_;
  std::vector<std::string> names_;
  std::map<std::string, decltype(Keeper::kept)> files_;
};

using ToldWords = std::vector<std::string>;
/// The values of `motion`.
inline std::vector<std::byte> motion_of(float x, float y, float v) { return values_of(x, y, v); }

}  // namespace rink::rti::testing
