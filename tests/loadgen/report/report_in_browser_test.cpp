// Reports as their readers see them: opened in a browser without a screen, in light and dark, in a
// wide and a narrow window.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "loadgen/measure/judge_run.h"
#include "loadgen/report/report.h"
#include "tests/command.h"
#include "tests/loadgen/report/canned_reports.h"

namespace rink::loadgen {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int wide_px = 1280, narrow_px = 360;

std::size_t count_of(const std::string& what, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

/// `text` with `added` before the first `place`.
std::string with(std::string text, const std::string& place, const std::string& added) {
  const std::size_t at = text.find(place);
  EXPECT_NE(at, std::string::npos) << place;
  return at == std::string::npos ? text : text.insert(at, added);
}

/// What the browser found on a page (browser_probe.js).
struct Looked {
  int width_px = 0;
  bool is_dark = false;
  std::size_t plots = 0, texts = 0, marks = 0;
  std::vector<std::string> findings;
};

class ReportInBrowserLongTest : public test::CommandTest {
 protected:
  ReportInBrowserLongTest() : CommandTest("compare") {}

  void SetUp() override {
    if (std::system("chromium --version >/dev/null 2>&1") != 0)
      GTEST_SKIP() << "there is no chromium";
  }

  /// Runs `experiment` into the folder `out` and gives its page.
  std::string report_of_experiment(const std::string& experiment) {
    std::ofstream(file("small.toml")) << experiment;
    EXPECT_EQ(run("compare " + file("small.toml") + " --out " + file("out")), 0) << said_;
    return content("out/report.html");
  }

  /// Opens all of `pages` in windows of this width. A window of the browser itself cannot be as
  /// narrow as a telephone's, a frame can.
  std::vector<Looked> look(const std::vector<std::string>& pages, int width_px, bool is_dark) {
    const char* listening =
        "<script>window.said = [];\naddEventListener('error', event => said.push('error: ' + "
        "event.message), true);\n"
        "console.error = (...words) => said.push('error: ' + words.join(' '));</script>\n";
    std::string frames;
    for (std::size_t i = 0; i < pages.size(); ++i) {
      const std::string name = "page" + std::to_string(i) + ".html";
      std::ofstream(file(name)) << with(pages[i], "<meta", listening);
      frames += "<iframe src=\"" + name + "\" width=\"" + std::to_string(width_px) +
                "\" height=\"900\" style=\"border:0\"></iframe>\n";
    }
    std::ofstream(file("frames.html"))
        << "<!DOCTYPE html><html><head><meta charset=\"utf-8\"/></head><body>" << frames
        << "<pre id=\"looked\"></pre><script>"
        << test::text_of(test::source_folder() + "/tests/loadgen/report/browser_probe.js") << R"js(
addEventListener('load', () => {
  const looked = [...document.querySelectorAll('iframe')].map(frame => findings_of(frame.contentWindow));
  document.getElementById('looked').textContent = JSON.stringify(looked).replace(/[&<>]/g, letter => '\\u00' + letter.charCodeAt(0).toString(16));
});</script></body></html>)js";
    const std::string options =
        "--headless --no-sandbox --disable-gpu --disable-quic --no-first-run "
        "--disable-background-networking --disable-component-update --disable-sync "
        "--allow-file-access-from-files --enable-logging=stderr --window-size=1280,900 "
        "--user-data-dir=" +
        file("browser");
    const std::string scheme =
        std::string(" --blink-settings=preferredColorScheme=") + (is_dark ? "0" : "1");
    const int status =
        std::system(("timeout 120 chromium " + options + scheme + " --dump-dom file://" +
                     file("frames.html") + " >" + file("dom") + " 2>" + file("said"))
                        .c_str());
    EXPECT_EQ(status, 0) << content("said");
    return looked_in(content("dom"), pages.size());
  }

  /// What the page's own console says beside what scripts can listen to: attributes that are no
  /// numbers, files that are missing.
  std::vector<std::string> console_of_pages() const {
    std::vector<std::string> lines;
    std::istringstream said(content("said"));
    for (std::string line; std::getline(said, line);)
      if (line.find("CONSOLE") != std::string::npos &&
          line.find("source: file:") != std::string::npos)
        lines.push_back(line);
    return lines;
  }

  /// Expects `page` to be without fault, light and dark, wide and narrow.
  void expect_faultless(const std::string& page) {
    ASSERT_NE(page, "");
    for (const bool is_dark : {false, true})
      for (const int width_px : {wide_px, narrow_px}) {
        SCOPED_TRACE(std::string(is_dark ? "dark, " : "light, ") + std::to_string(width_px) +
                     " px");
        const Looked looked = look({page}, width_px, is_dark).at(0);
        EXPECT_EQ(looked.width_px, width_px);
        EXPECT_EQ(looked.is_dark, is_dark);
        EXPECT_EQ(looked.plots, count_of("<svg ", page)) << "each is looked at";
        EXPECT_GE(looked.texts,
                  count_of("<text ", page) + count_of("<td", page) - count_of("<td></td>", page));
        EXPECT_GE(looked.marks, looked.plots);
        EXPECT_THAT(looked.findings, IsEmpty());
        EXPECT_THAT(console_of_pages(), IsEmpty());
      }
  }

 private:
  static std::vector<Looked> looked_in(const std::string& dom, std::size_t pages) {
    const std::string opening = "<pre id=\"looked\">";
    const std::size_t begin = dom.find(opening) + opening.size();
    const auto all =
        nlohmann::json::parse(dom.substr(begin, dom.find("</pre>", begin) - begin), nullptr, false);
    EXPECT_EQ(all.size(), pages) << "the probe came to its end";
    std::vector<Looked> result(pages);
    for (std::size_t i = 0; i < pages && i < all.size() && all.is_array(); ++i)
      result[i] = {all[i]["width"], all[i]["is_dark"], all[i]["plots"].size(),
                   all[i]["texts"], all[i]["marks"],   all[i]["findings"]};
    return result;
  }
};

constexpr const char* in_virtual_time =
    "scene = 'arena'\ntick_rate_hz = 20\nduration_s = 2\nwarm_up_s = 0.3\ntransport = 'virtual'\n";

TEST_F(ReportInBrowserLongTest, PartsPoliciesAndLongNamesOfSchemes) {
  const std::string page =
      report_of_experiment("name = 'A report with a long name, of parts with and without delay'\n" +
                           std::string(in_virtual_time) + R"(seeds = [1, 2, 3]
clients = [4, 8]
delay_ms = 0
[[parts]]
name = 'prompt'
schemes = ['none', 'region', 'aura with dwell(matches=3)', 'region or strips with priority(budget=60)', 'region or strips with priority(budget=30)']
policies = ['periodic', 'snapshot', 'dead-reckoning', 'on-event']
[[parts]]
name = 'late'
schemes = ['none', 'region', 'aura with dwell(matches=3)']
policies = ['periodic', 'on-event']
clients = 8
seeds = [1, 2]
delay_ms = 50
view_margin = [0, 0.3]
extrapolate = [true, false]
[[parts]]
name = 'rates'
curves = true
schemes = 'region'
policies = ['periodic', 'snapshot', 'on-event']
clients = 4
seeds = [1, 2]
duration_s = 1
tick_rate_hz = [30, 15, 20, 45, 90]
view_margin = [0, 0.3]
[[parts]]
name = 'thresholds'
curves = true
schemes = 'region'
policies = 'dead-reckoning'
clients = 4
seeds = [1, 2]
duration_s = 1
tick_rate_hz = 30
threshold = [0.001, 0.002, 0.005, 0.01, 0.02]
view_margin = [0, 0.3]
)");
  for (const char* plot :
       {"bytes-against-error", "bytes-by-kind", "curves-payload-delay0", "curves-wire-delay0",
        "displayed-error-distribution", "key-to-effect", "late-discovery-prompt",
        "late-discovery-late", "late-entry", "payload-against-clients",
        "precision-recall-delivered", "recall-against-delay", "replications-payload", "stages",
        "wire-against-clients"})
    EXPECT_NE(content("out/plots/" + std::string(plot) + ".svg"), "") << plot;
  expect_faultless(page);
}

TEST_F(ReportInBrowserLongTest, ModesAndSweptParameters) {
  const std::string page =
      report_of_experiment("name = 'modes'\n" + std::string(in_virtual_time) +
                           "seeds = [1, 2]\nmodes = ['client-server', 'peer-to-peer']\n"
                           "schemes = ['none', 'region', 'aura']\npolicies = 'on-event'\n"
                           "clients = [4, 8, 16]\npopulation = 'per_client'\nview_area = "
                           "4.0\ndelay_ms = 10\nview_margin = [0, 0.1, 0.3]\n");
  for (const char* plot :
       {"busiest-node-bytes", "link-bytes", "traffic-by-subject", "sweep-view_margin"})
    EXPECT_NE(content("out/plots/" + std::string(plot) + ".svg"), "") << plot;
  expect_faultless(page);
}

TEST_F(ReportInBrowserLongTest, ASingleRun) {
  expect_faultless(report_of_experiment("name = 'one'\n" + std::string(in_virtual_time) +
                                        "schemes = 'region'\nbaseline_scheme = 'region'\npolicies "
                                        "= 'periodic'\nclients = 3\nseeds = 7\n"));
}

/// Processor costs, which runs in virtual time do not have, with a run that does not count and a
/// name without a space to break at.
std::string page_with_costs() {
  std::vector<RunRecord> runs;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6})
    for (const std::uint32_t clients : {12u, 25u, 50u, 100u})
      for (const char* scheme :
           {"none", "region", "aura with tiers(at=0.3 at=0.6) with priority(budget=400)"})
        for (const char* policy : {"periodic", "on-event"}) {
          const Cell cell{"client-server", scheme, policy, clients, seed};
          auto server = canned_server_report(cell);
          server["send_us_per_tick"] = 30.0 * clients + 5.0 * static_cast<double>(seed);
          server["physics_us_per_tick"] = 300.0 + static_cast<double>(seed);
          server["state_hash"] = "00112233445566a" + std::to_string(seed);
          if (clients == 100) server["ticks_on_time_fraction"] = 0.95;
          RunRecord run = record_for(small_experiment(), cell);
          run.population = "fixed";
          judge(run, server, canned_bots_report(cell));
          runs.push_back(run);
        }
  runs.back().valid = false;
  runs.back().why_invalid = "the server ended with status 1: /a/folder/whose/name/is/longer/than/" +
                            std::string(200, 'x');
  Experiment experiment = small_experiment();
  experiment.text = "schemes = ['none', 'region']  # " + std::string(200, '-');
  return report_of(
             experiment, runs,
             {{{"command", "rink-compare " + std::string(300, 'y')}, {"kernel", "Linux <6>"}}})
      .html;
}

TEST_F(ReportInBrowserLongTest, CostsGrowthAndRunsThatDoNotCount) {
  const std::string page = page_with_costs();
  for (const char* id :
       {"id=\"cost\"", "Cost of a tick against clients", "id=\"invalid\"", "kernel"})
    EXPECT_THAT(page, HasSubstr(id));
  expect_faultless(page);
}

/// A browser that looked at nothing would find nothing: each fault put in by hand is named, and
/// nothing else is.
TEST_F(ReportInBrowserLongTest, FaultsPutInByHandAreNamed) {
  const std::string page = page_with_costs(),
                    axis =
                        "<line x1=\"5\" y1=\"90\" x2=\"95\" y2=\"90\" class=\"base\"/><line "
                        "x1=\"5\" y1=\"50\" x2=\"5\" y2=\"90\" class=\"base\"/>";
  struct Fault {
    std::string place, added, finding;
  };
  const std::vector<Fault> faults = {
      {"</body>", "<script>throw new Error('broken')</script>", "error: Uncaught Error: broken"},
      {"</body>", "<script>console.error('a complaint')</script>", "error: a complaint"},
      {"</body>", "<div style=\"width:2000px\">too long</div>", "wide: the page is "},
      {"</body>", "<div style=\"margin-left:-1000px;width:2000px\">too far</div>",
       "wide: div \"too far\" at 360 px"},
      {"</body>",
       "<div style=\"width:50px;overflow:hidden;white-space:nowrap\">words that end too soon</div>",
       "cut off: div \"words that end too soon\" at 360 px shows 50 of "},
      {"</body>", "<p style=\"color:#777;background:#888\">grey on grey</p>",
       "pale: \"grey on grey\" has a contrast of 1."},
      {"</svg>", "<text x=\"900\" y=\"40\" class=\"note\">far away</text>",
       "cut off: \"far away\" of plot "},
      {"</svg>", "<text x=\"9\" y=\"-30\" class=\"note\">high above</text>",
       "cut off: \"high above\" of plot "},
      {"</svg>",
       "<text x=\"40\" y=\"80\" style=\"fill:var(--card)\" class=\"note\">as its card</text>",
       "pale: \"as its card\" of plot "},
      {"</svg>",
       "<text x=\"100\" y=\"100\" class=\"tick\">one</text><text x=\"105\" y=\"100\" "
       "class=\"tick\">two</text>",
       "overlap: \"one\" and \"two\" of plot "},
      {"</svg>", "<circle cx=\"1\" cy=\"1\" r=\"3\" class=\"dot s0\"/>",
       "outside: a dot s0 of plot "},
      {"</svg>", "<circle cx=\"99\" cy=\"150\" r=\"3\" style=\"fill:var(--card)\" class=\"dot\"/>",
       "unseen: a dot of plot "},
      {"</body>",
       "<svg viewBox=\"0 0 100 100\"><text class=\"title\" y=\"15\">Nothing</text>" + axis +
           "</svg>",
       "empty: plot \"Nothing\" at 360 px has no mark"},
      {"</body>",
       "<svg viewBox=\"0 0 100 100\"><text class=\"title\" y=\"15\">Names</text><path d=\"M20 "
       "40h8v8z\" class=\"mark s1\"/>"
       "<text x=\"38\" y=\"48\" class=\"legend\">a</text>" +
           axis + "</svg>",
       "empty: plot \"Names\" at 360 px has no mark"},
  };
  std::vector<std::string> pages;
  for (const Fault& fault : faults) pages.push_back(with(page, fault.place, fault.added));
  const auto looked = look(pages, narrow_px, false);
  for (std::size_t i = 0; i < faults.size(); ++i)
    EXPECT_THAT(looked[i].findings, Contains(HasSubstr(faults[i].finding))) << faults[i].added;
  EXPECT_THAT(console_of_pages(), testing::SizeIs(1)) << "the script that threw";
  look({with(page, "</svg>", "<path d=\"Mnan 1\" class=\"line s0\"/>")}, narrow_px, false);
  EXPECT_THAT(console_of_pages(), Contains(HasSubstr("attribute d: Expected number")));
}

}  // namespace
}  // namespace rink::loadgen
