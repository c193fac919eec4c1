// Reads the journal, checks that it is of the same experiment and program, and cuts off its torn
// end.
#include "loadgen/run/resume.h"

#include "loadgen/run/campaign.h"

namespace rink::loadgen {
namespace {

/// The reason why runs of `found` cannot be combined with those of `own`; empty if they can.
std::string mismatch_of(const Journal& found, const JournalHead& own) {
  if (!found.head) return "its first line does not say which experiment and program they come from";
  if (found.head->experiment != own.experiment)
    return "they are of another experiment: its text, scene or recorded keys were changed since";
  if (found.head->commit != own.commit)
    return "they were made by commit " + found.head->commit + ", and this program is of commit " +
           own.commit;
  return {};
}

}  // namespace

std::filesystem::path latest_directory(const std::filesystem::path& parent) {
  std::filesystem::path latest = parent / "report";
  for (int number = 2;; ++number) {
    const std::filesystem::path next = parent / ("report-" + std::to_string(number));
    if (!std::filesystem::exists(next)) return latest;
    latest = next;
  }
}

Continuation continued_in(const std::filesystem::path& path, const Experiment& experiment,
                          const JournalHead& own, bool is_forced) {
  const std::filesystem::path file = path / "runs.jsonl";
  std::error_code is_missing;
  const auto size = std::filesystem::file_size(file, is_missing);
  if (is_missing || size == 0) {
    if (!is_forced && std::filesystem::exists(path / "summary.csv"))
      throw OutputError(file.string() +
                        ": holds no runs to go on with, and other results stand beside it; choose "
                        "another --out, or replace them with --resume --force");
    return {ResultsDirectory(path, is_forced),
            {},
            path.string() + ": nothing to go on with, starting afresh\n"};
  }
  const Journal journal = read_journal(file);
  const std::string mismatch = mismatch_of(journal, own);
  std::string said;
  if (!mismatch.empty()) {
    if (!is_forced)
      throw OutputError(file.string() + ": its runs cannot be gone on with: " + mismatch +
                        "; choose another --out, or mix them with --resume --force");
    said += file.string() + ": mixed in with --force although " + mismatch + "\n";
  }
  if (journal.is_truncated)
    said += file.string() + ": the last line is torn, as a kill leaves it; that cell runs again\n";
  Continuation result{ResultsDirectory::resumed(path, journal.whole_bytes),
                      runs_to_keep(experiment, journal.runs),
                      {}};
  result.said = said + path.string() + ": going on, " + std::to_string(result.kept.size()) +
                " of " + std::to_string(cells_of(experiment).size()) + " cells are done\n";
  return result;
}

}  // namespace rink::loadgen
