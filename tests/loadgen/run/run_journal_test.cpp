// Runs read back from their journal: nothing is lost, a line at which the writer was killed is told
// apart from one that is wrong.
#include "loadgen/run/run_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "loadgen/measure/judge_run.h"
#include "loadgen/measure/results.h"
#include "loadgen/measure/run_fields.h"
#include "tests/loadgen/report/canned_reports.h"
#include "tests/temporary_folder.h"

namespace rink::loadgen {
namespace {

using testing::HasSubstr;

const Cell cell_of_odd_numbers{
    "client-server",
    "grid",
    "periodic",
    10,
    4,
    {.view_fraction = 0.1, .view_margin = 0.25, .sweep_ticks = 3, .cell_size = 1.0 / 3.0},
    500,
    50,
    2};

RunRecord plain_run() {
  RunRecord run = record_for(small_experiment(), cell_of_odd_numbers);
  judge(run, canned_server_report(cell_of_odd_numbers), canned_bots_report(cell_of_odd_numbers));
  return run;
}

/// Every number of a line replaced by a different one, so that no key can be mistaken for another.
nlohmann::ordered_json line_of_distinct_values() {
  nlohmann::ordered_json line = to_json(plain_run());
  std::uint64_t next = 1;
  const auto replace = [&next](nlohmann::ordered_json& value) {
    if (value.is_number_float() || value.is_null()) value = next++;
    else if (value.is_number()) value = next++;
    else if (value.is_string()) value = "text " + std::to_string(next++);
  };
  for (auto& [key, value] : line.items()) {
    if (key == "relevance" || key == "truth_trouble" || key == "keys_trouble") value = "a disc";
    else if (value.is_object())
      for (auto& [name, part] : value.items()) replace(part);
    else replace(value);
  }
  line["server_cores"] = 2;
  line["bytes_by_field"] =
      nlohmann::ordered_json::parse(R"([["down","stream","updates","place.x",1.5,2.5]])");
  return line;
}

class JournalFile : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& content) const {
    std::ofstream(folder_ / "runs.jsonl", std::ios::binary) << content;
    return folder_ / "runs.jsonl";
  }
  std::string complaint_about(const std::string& content) const {
    try {
      read_journal(written(content));
    } catch (const OutputError& error) {
      return error.what();
    }
    return "no complaint";
  }
  test::TemporaryFolder folder_{"journal"};
  const std::string line_ = to_json(plain_run()).dump() + "\n";
};

TEST_F(JournalFile, OfAnotherSchemaIsRefusedByItsNumber) {
  const std::string head = to_json(JournalHead{"0123", "abc", {}}).dump();
  EXPECT_EQ(complaint_about(head + "\n" + line_), "no complaint");
  std::string other = head, older = head;
  other.replace(other.find("\"schema\":1"), 10, "\"schema\":2");
  older.erase(older.find("\"schema\":1,"), 11);
  EXPECT_THAT(complaint_about(other + "\n" + line_),
              testing::HasSubstr("runs.jsonl:1: schema 2; this version reads schema 1"));
  EXPECT_THAT(complaint_about(older + "\n" + line_),
              testing::HasSubstr("runs.jsonl:1: schema none; this version reads schema 1"));
}

TEST_F(JournalFile, ARunReadBackIsWrittenAsTheSameLine) {
  std::string complaint;
  for (const nlohmann::ordered_json& line :
       {to_json(plain_run()), to_json(RunRecord{}), line_of_distinct_values()}) {
    const auto run = run_record_from_json(nlohmann::json::parse(line.dump()), complaint);
    ASSERT_TRUE(run) << complaint;
    EXPECT_EQ(nlohmann::json::parse(to_json(*run).dump()), nlohmann::json::parse(line.dump()));
  }
}

TEST_F(JournalFile, EveryCutOfAJournalLosesAtMostTheLastLine) {
  const std::string head = to_json(JournalHead{"identity", "abc", {{"kernel", "Linux"}}}).dump() +
                           "\n",
                    content = head + line_ + line_;
  for (std::size_t length = head.size(); length <= content.size();
       length += length + 7 < content.size() ? 7 : 1) {
    const Journal journal = read_journal(written(content.substr(0, length)));
    ASSERT_TRUE(journal.head);
    EXPECT_EQ(journal.head->commit, "abc");
    EXPECT_EQ(journal.runs.size(), (length - head.size()) / line_.size());
    EXPECT_EQ(journal.is_truncated, (length - head.size()) % line_.size() != 0);
    EXPECT_EQ(journal.whole_bytes, head.size() + journal.runs.size() * line_.size());
  }
}

TEST_F(JournalFile, AJournalWithoutAHeadIsReadAndAnEmptyOneHasNoRuns) {
  EXPECT_EQ(read_journal(written(line_)).runs.size(), 1u);
  EXPECT_FALSE(read_journal(written(line_)).head);
  EXPECT_TRUE(read_journal(written("")).runs.empty());
}

TEST_F(JournalFile, AWholeLineThatIsNoRunIsNamed) {
  EXPECT_THAT(complaint_about(line_ + "{\"mode\": \n"), HasSubstr("runs.jsonl:2: not JSON"));
  EXPECT_THAT(complaint_about("7\n"), HasSubstr("runs.jsonl:1: mode is missing"));
  EXPECT_THAT(complaint_about("{\"provenance\": {}, \"experiment\": 5, \"commit\": \"x\"}\n"),
              HasSubstr("runs.jsonl:1: mode is missing"));
  nlohmann::json line = nlohmann::json::parse(line_);
  line["update_age_ms"]["p99"] = "soon";
  EXPECT_THAT(complaint_about(line_ + line.dump() + "\n"),
              HasSubstr(":2: update_age_ms.p99 is missing or not a number"));
  line = nlohmann::json::parse(line_);
  line["clients"] = -3;
  EXPECT_THAT(complaint_about(line.dump() + "\n"),
              HasSubstr(":1: clients is missing or not a count"));
  EXPECT_THROW(read_journal("/nowhere/runs.jsonl"), OutputError);
}

/// Whoever goes on with an experiment must have the same text, the same scene and the same recorded
/// keys.
TEST(ExperimentIdentity, IsThatOfItsTextItsSceneAndItsKeys) {
  const test::TemporaryFolder folder("identity");
  const auto write = [&](const char* name, const char* text) {
    std::ofstream(folder / name) << text;
  };
  Experiment experiment = small_experiment();
  experiment.text = "name = 'x'";
  experiment.scene = (folder / "scene.toml").string(),
  experiment.players = (folder / "game.keys").string();
  write("scene.toml", "one"), write("game.keys", "two");
  const std::string identity = identity_of(experiment);
  EXPECT_EQ(identity_of(experiment), identity);
  for (const char* file : {"scene.toml", "game.keys"}) {
    const std::string before = file == std::string("game.keys") ? "two" : "one";
    write(file, "other");
    EXPECT_NE(identity_of(experiment), identity) << file;
    write(file, before.c_str());
    EXPECT_EQ(identity_of(experiment), identity);
  }
  experiment.text += " ";
  EXPECT_NE(identity_of(experiment), identity);
}

}  // namespace
}  // namespace rink::loadgen
