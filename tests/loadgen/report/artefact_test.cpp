// A report folder holds all that it takes to repeat it, and says what is missing or altered.
#include "loadgen/report/artefact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/command.h"

namespace rink::loadgen {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class ReportFolder : public test::CommandTest {
 protected:
  ReportFolder() : CommandTest("artefact") {
    write("small.toml",
          "name = 'small'\nscene = 'own.toml'\npopulation = 'per_client'\nschemes = ['none', "
          "'region']\nclients = 3\nduration_s = 0.5\nwarm_up_s = 0.1\ntransport = 'virtual'\n"
          "baseline = { scheme = 'none' }\n");
    std::filesystem::copy_file(test::source_folder() + "/scenes/crowd.toml", folder_ / "own.toml");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  void replace(const std::string& name, const std::string& what, const std::string& by) const {
    std::string text = content(name);
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    write(name, text.replace(at, what.size(), by));
  }
  std::string content(const std::string& name) const { return test::text_of(folder_ / name); }
  int make() { return run("compare " + file("small.toml") + " --out " + file("first")); }
  int repeat(const std::string& more = "") {
    return run("compare --from " + file("first") + " --out " + file("second") + " --force" + more);
  }
};

TEST_F(ReportFolder, IsRepeatedWithTheSameFiguresThoughSceneAndExperimentHaveGone) {
  ASSERT_EQ(make(), 0) << said_;
  std::filesystem::remove(folder_ / "own.toml");
  std::filesystem::remove(folder_ / "small.toml");
  EXPECT_EQ(repeat(), 0) << said_;
  EXPECT_THAT(printed_, HasSubstr("2 of 2 runs in virtual time agree in every figure"));
  EXPECT_EQ(run("compare --from " + file("second") + " --out " + file("third")), 0)
      << "what repeats is a report folder itself: " << said_;
}

TEST_F(ReportFolder, OfRunsThatStartWarmHoldsTheirSavedGamesAndIsRepeatedFromThem) {
  write("small.toml",
        content("small.toml") +
            "start_s = 2\n[[parts]]\nname = 'warm'\n[[parts]]\nname = 'warmer'\nstart_s = 3\n");
  ASSERT_EQ(make(), 0) << said_;
  EXPECT_EQ(repeat(), 0) << said_;
  EXPECT_THAT(printed_, HasSubstr("4 of 4 runs in virtual time agree in every figure"));
  std::vector<std::string> saved;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "first/keys"))
    if (entry.path().extension() == ".state")
      saved.push_back("first/keys/" + entry.path().filename().string());
  ASSERT_EQ(saved.size(), 2u) << "a game for each part";
  EXPECT_NE(content(saved[0]), content(saved[1]));
  write(saved[1], content(saved[1]) + " ");
  EXPECT_EQ(repeat(), 10);
  EXPECT_THAT(said_, HasSubstr(file(saved[1]) + ": altered since the report was written"));
}

TEST_F(ReportFolder, IsRepeatedWithTheReplicationsThatItHoldsWhateverItsExperimentLists) {
  ASSERT_EQ(run("compare " + file("small.toml") + " --out " + file("first") + " --seeds 3"), 0)
      << said_;
  EXPECT_EQ(repeat(), 0) << said_;
  EXPECT_THAT(printed_, AllOf(HasSubstr("6 of 6 runs in virtual time agree in every figure"),
                              Not(HasSubstr("not repeated"))))
      << "the file says one seed";
  EXPECT_EQ(repeat(" --seeds 2"), 0) << said_;
  EXPECT_THAT(printed_, HasSubstr("4 of 4 runs in virtual time agree in every figure; 2 of "
                                  "its runs were not repeated"));
}

TEST_F(ReportFolder, OfWhichNoRunCanBeComparedIsNotCalledRepeated) {
  ASSERT_EQ(make(), 0) << said_;
  const std::string runs = content("first/runs.jsonl");
  const auto seal = [this] {
    write_manifest(
        ResultsDirectory::resumed(folder_ / "first", content("first/runs.jsonl").size()));
  };
  write("first/runs.jsonl", runs.substr(0, runs.find('\n') + 1));
  seal();
  EXPECT_EQ(repeat(), 11);
  EXPECT_THAT(said_, HasSubstr("no run of both can be compared"));
  write("first/runs.jsonl", runs);
  replace("first/runs.jsonl", "\"valid\":true", "\"valid\":false");
  seal();
  EXPECT_EQ(repeat(), 11);
  EXPECT_THAT(said_, HasSubstr("-3-seed1: counts, and did not before"));
  write("first/runs.jsonl", runs + "{}\n");
  seal();
  EXPECT_EQ(repeat(), 10) << "before anything runs";
  EXPECT_THAT(said_, AllOf(HasSubstr(file("first/runs.jsonl") + ":4: "), Not(HasSubstr("[1/"))));
}

TEST_F(ReportFolder, IsRefusedIfItsManifestNamesWhatNoFileBelowItCanBe) {
  ASSERT_EQ(make(), 0) << said_;
  const std::string manifest = content("first/manifest.json");
  for (const std::string& name :
       {std::string("../small.toml"), std::string("keys/../../small.toml"), file("small.toml"),
        std::string(), std::string("scene.toml\\u0000")}) {
    write("first/manifest.json", manifest);
    replace("first/manifest.json", "\"scene.toml\"", "\"" + name + "\"");
    EXPECT_EQ(repeat(), 10) << name;
    EXPECT_THAT(said_, HasSubstr(file("first/manifest.json") + ": \"" + name +
                                 "\" is no file below the folder"));
  }
  write("first/manifest.json", manifest);
  replace("first/manifest.json", "\"scene.toml\"", "\"" + std::string(5000, 'a') + "\"");
  EXPECT_EQ(repeat(), 10) << "longer than a file's name can be";
  EXPECT_THAT(said_, HasSubstr("a: missing, but named in the manifest"));
}

TEST_F(ReportFolder, HoldsRecordedKeysWhereverTheExperimentFoundThem) {
  const std::string text = content("small.toml");
  ASSERT_EQ(make(), 0) << said_;
  std::filesystem::create_directory(folder_ / "sub");
  for (const std::string& named : {std::string("sub/game.keys"), file("elsewhere.keys")}) {
    const std::filesystem::path log = folder_ / named;  // an absolute path stays what it is
    std::filesystem::copy_file(folder_ / "first/keys/seed1-3.keys", log);
    write("small.toml", text + "players = '" + named + "'\n");
    ASSERT_EQ(run("compare " + file("small.toml") + " --out " + file("recorded") + " --force"), 0)
        << said_;
    std::filesystem::remove(log);
    EXPECT_EQ(run("compare --from " + file("recorded") + " --out " + file("second") + " --force"),
              0)
        << said_;
    EXPECT_THAT(printed_, HasSubstr("2 of 2 runs in virtual time agree in every figure"));
  }
}

TEST_F(ReportFolder, OfPartsIsRepeatedWithTheReplicationsOfEach) {
  write("small.toml", content("small.toml") +
                          "[[parts]]\nname = 'one'\n[[parts]]\nname = 'other'\ndelay_ms = 10\n");
  ASSERT_EQ(run("compare " + file("small.toml") + " --out " + file("first") + " --seeds 2"), 0)
      << said_;
  EXPECT_EQ(repeat(), 0) << said_;
  EXPECT_THAT(printed_, HasSubstr("8 of 8 runs in virtual time agree in every figure"));
}

TEST_F(ReportFolder, ThatSaysSomethingElseEndsWithAStatusOfItsOwnAndNamesTheRun) {
  ASSERT_EQ(make(), 0) << said_;
  replace("first/runs.jsonl", "\"update_age_samples\":", "\"update_age_samples\":1");
  write_manifest(ResultsDirectory::resumed(folder_ / "first", content("first/runs.jsonl").size()));
  EXPECT_EQ(repeat(), 11);
  EXPECT_THAT(said_, AllOf(HasSubstr("1 of 2 runs in virtual time agree"),
                           HasSubstr("-3-seed1: other figures in virtual time")));
}

TEST_F(ReportFolder, IsNeverOverwrittenByItsOwnRepetition) {
  ASSERT_EQ(make(), 0) << said_;
  replace("first/runs.jsonl", "\"update_age_samples\":", "\"update_age_samples\":1");
  write_manifest(ResultsDirectory::resumed(folder_ / "first", content("first/runs.jsonl").size()));
  const std::string before = content("first/runs.jsonl");
  for (const char* same : {"first", "first/", "first/../first"}) {
    EXPECT_EQ(run("compare --from " + file("first") + " --out " + file(same) + " --force"), 2)
        << same;
    EXPECT_THAT(said_, HasSubstr("is the folder of --from"));
    EXPECT_EQ(content("first/runs.jsonl"), before);
  }
}

TEST_F(ReportFolder, OfAnotherCommitIsRepeatedAndThatIsSaid) {
  ASSERT_EQ(make(), 0) << said_;
  EXPECT_EQ(repeat(), 0) << said_;
  EXPECT_THAT(said_, Not(HasSubstr("made by commit")));
  std::string runs = content("first/runs.jsonl");
  runs.insert(runs.rfind("\"commit\":\"", runs.find('\n')) + 10, "abc");  // behind the provenance
  write("first/runs.jsonl", runs);
  write_manifest(ResultsDirectory::resumed(folder_ / "first", content("first/runs.jsonl").size()));
  EXPECT_EQ(repeat(), 0) << said_;
  EXPECT_THAT(said_,
              AllOf(HasSubstr("first: made by commit abc"), HasSubstr(", repeated by commit ")));
}

TEST_F(ReportFolder, KeepsTheEvidenceOfPointsOfCurvesIfAskedTo) {
  write("small.toml", content("small.toml") +
                          "[[parts]]\nname = 'shown'\n[[parts]]\nname = 'points'\ncurves = "
                          "true\nschemes = 'region'\n");
  const auto evidence_of_points = [this](const std::string& folder) {
    return std::ranges::count_if(
        std::filesystem::directory_iterator(folder_ / folder / "cells"), [](const auto& entry) {
          const std::string name = entry.path().filename().string();
          return name.starts_with("points-") && name.ends_with(".bots.jsonl");
        });
  };
  ASSERT_EQ(make(), 0) << said_;
  EXPECT_EQ(evidence_of_points("first"), 0);
  EXPECT_EQ(repeat(" --keep-evidence"), 0) << said_;
  EXPECT_THAT(printed_, HasSubstr("3 of 3 runs in virtual time agree in every figure"));
  EXPECT_EQ(evidence_of_points("second"), 1);
}

TEST_F(ReportFolder, IsRefusedByTheFileThatIsAlteredOrMissing) {
  ASSERT_EQ(make(), 0) << said_;
  for (const char* name : {"first/scene.toml", "first/experiment.toml", "first/runs.jsonl",
                           "first/keys/seed1-3.keys", "first/report.html"}) {
    const std::string before = content(name);
    ASSERT_FALSE(before.empty()) << name;
    write(name, before + " ");
    EXPECT_EQ(repeat(), 10) << name;
    EXPECT_THAT(said_, HasSubstr(file(name) + ": altered since the report was written"));
    std::filesystem::remove(folder_ / name);
    EXPECT_EQ(repeat(), 10) << name;
    EXPECT_THAT(said_, HasSubstr(file(name) + ": missing, but named in the manifest"));
    write(name, before);
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "second")) << "nothing was begun";
  EXPECT_EQ(repeat(), 0) << said_;
}

TEST_F(ReportFolder, OfAnotherVersionOrNoneIsNamed) {
  ASSERT_EQ(make(), 0) << said_;
  replace("first/manifest.json", "\"schema\": 1", "\"schema\": 2");
  EXPECT_EQ(repeat(), 10);
  EXPECT_THAT(said_, AllOf(HasSubstr("manifest.json: of schema 2, written by version"),
                           HasSubstr("this program reads schema 1")));
  replace("first/manifest.json", "\"schema\": 2", "\"schema\": 1");
  replace("first/manifest.json", "\"version\": \"", "\"version\": \"9");
  EXPECT_EQ(repeat(), 10);
  EXPECT_THAT(said_, AllOf(HasSubstr("manifest.json: written by version \"9"),
                           HasSubstr("; this is version ")));
  write("first/manifest.json", "[]");
  EXPECT_EQ(repeat(), 10);
  EXPECT_THAT(said_, HasSubstr("not a manifest of a report folder"));
  std::filesystem::remove(folder_ / "first/manifest.json");
  EXPECT_EQ(repeat(), 10);
  EXPECT_THAT(said_, HasSubstr("manifest.json: cannot be read"));
  EXPECT_NE(run("compare small --from " + file("first")), 0) << "either an experiment or a folder";
  EXPECT_EQ(run("compare --from " + file("nowhere")), 2);
}

/// Without the comments, of which the command line is one.
TEST_F(ReportFolder, HasTheSameDelaysOfDiscoveryThoughItWasInterrupted) {
  const auto lines = [this] {
    const std::string all = content("first/discovery.csv");
    return all.substr(all.find("\npart,mode"));
  };
  replace("small.toml", "duration_s = 0.5", "duration_s = 1.5");
  ASSERT_EQ(make(), 0) << said_;
  const std::string before = lines();
  EXPECT_THAT(before,
              AllOf(HasSubstr(",none,"), HasSubstr(",region,"), HasSubstr(",late_discovery,")));
  const std::string runs = content("first/runs.jsonl");
  write("first/runs.jsonl", runs.substr(0, runs.rfind('\n', runs.size() - 2) + 1));
  std::filesystem::remove(folder_ / "first/discovery.csv");
  EXPECT_EQ(run("compare " + file("small.toml") + " --resume --out " + file("first")), 0) << said_;
  EXPECT_EQ(lines(), before);
}

/// With `curves` no run leaves evidence.
TEST_F(ReportFolder, KeepsNoDelaysOfDiscoveryOfAnotherExperiment) {
  ASSERT_EQ(make(), 0) << said_;
  ASSERT_TRUE(std::filesystem::exists(folder_ / "first/discovery.csv"));
  write("small.toml", content("small.toml") + "[[parts]]\nname = 'far'\ncurves = true\n");
  EXPECT_EQ(run("compare " + file("small.toml") + " --out " + file("first") + " --force"), 0)
      << said_;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "first/discovery.csv"));
}

TEST_F(ReportFolder, WithARelevanceExpressionThatIsNoneEndsWithItsOwnStatus) {
  const std::string before = content("small.toml");
  write("small.toml", "relevance = 'filter'\nrelevant = 'aura and nott sight'\n" + before);
  EXPECT_EQ(make(), 12);
  EXPECT_THAT(said_, AllOf(HasSubstr("small.toml:2: relevant = 'aura and nott sight'"),
                           HasSubstr("at character 15")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "first")) << "nothing was begun";
  write("small.toml", "relevance = 'disc'\nrelevant = 'aura'\n" + before);
  EXPECT_EQ(make(), 2) << "an experiment that is wrong otherwise";
  write("small.toml", "relevance = 'filter'\nrelevant = 'aura or team'\n" + before);
  EXPECT_EQ(make(), 0) << said_;
  EXPECT_EQ(repeat(), 0) << said_;
}

TEST_F(ReportFolder, WithABaselineOfAWholeNumberThatIsNoDoubleIsRefusedByThatNumber) {
  replace("small.toml", "scheme = 'none' }", "clients = 9223372036854775807 }");
  EXPECT_EQ(make(), 8);
  EXPECT_THAT(said_, HasSubstr("baseline.clients = 9223372036854775807: no value of that key"));
}

TEST_F(ReportFolder, WithABaselineThatOnlyCellsWithoutThatParameterCouldHaveEndsWithThatStatusToo) {
  replace("small.toml", "scheme = 'none' }", "view_margin = 0.2 }");
  EXPECT_EQ(make(), 8);
  EXPECT_THAT(said_, HasSubstr("baseline: no cell of the experiment is view_margin 0.2"));
}

TEST_F(ReportFolder, WithABaselineThatNoCellHasEndsWithItsOwnStatus) {
  replace("small.toml", "scheme = 'none'", "scheme = 'grid'");
  EXPECT_EQ(make(), 8);
  EXPECT_THAT(said_, HasSubstr("no cell of the experiment is grid"));
  replace("small.toml", "scheme = 'grid'", "scheme = 'none'");
  EXPECT_EQ(run("compare " + file("small.toml") + " --out " + file("first") +
                " --seeds 4 --until-width 0.0001%"),
            9)
      << said_;
  EXPECT_THAT(said_, HasSubstr("after 4 replications the payload of"));
  EXPECT_EQ(run("compare " + file("small.toml") + " --until-width wide"), 2);
  EXPECT_EQ(run("compare " + file("small.toml") + " --out " + file("again") +
                " --seeds 4 --until-width 90%"),
            0)
      << said_;
  EXPECT_THAT(content("again/report.html"), HasSubstr("6 of 6 cells run"))
      << "three replications are enough for that";
  for (const char* baseline : {"baseline_scheme = 'aura'", "baseline_policy = 'snapshot'"}) {
    replace("small.toml", content("small.toml").substr(content("small.toml").find("baseline")),
            std::string(baseline) + "\n");
    EXPECT_EQ(make(), 8) << baseline;
    EXPECT_THAT(said_, HasSubstr("one that is compared: ")) << baseline;
  }
}

}  // namespace
}  // namespace rink::loadgen
