// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay/trace.h"

#include <sstream>
#include <string>

#include "catch.h"

using namespace pgdr::bench;

namespace {

Trace read(const std::string& text) {
  std::istringstream in(text);
  return read_trace(in);
}

std::string with_events(const std::string& events) {
  return R"({"displayTimeUnit":"ms","otherData":{"threads":2},"traceEvents":[)" + events + "]}";
}

std::string leaf(const std::string& args, const std::string& rest = R"(,"ts":1,"dur":1)") {
  return R"({"name":"leaf","cat":"leaf","ph":"X","pid":1,"tid":0)" + rest + R"(,"args":{)" + args + "}}";
}

void check_refused(const std::string& text, const std::string& word) {
  try {
    read(text);
    FAIL_CHECK("accepted: " << text);
  } catch (const Trace_error& error) {
    INFO(error.what());
    CHECK(std::string(error.what()).find(word) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("a trace is read, whatever the order of its members") {
  const Trace trace = read(R"({"traceEvents":[
    {"ph":"M","name":"thread_name","pid":1,"tid":0,"args":{"name":"worker 0","epoch":9}},
    {"args":{"inserted":7,"z":3,"y":2,"x":1,"level":2,"wave":1,"epoch":4},
     "dur":2000000,"ts":3.5e6,"tid":1,"ph":"X","cat":"leaf"},
    {"name":"leaf","cat":"leaf","ph":"X","ts":1000000.5,"dur":0.25,"tid":0,
     "args":{"epoch":4,"wave":0,"level":0,"x":0,"y":0,"z":0,"inserted":0,"more":{"epoch":8,"list":[1,2]}}},
    {"name":"sort","cat":"parallel","ph":"X","ts":2e6,"dur":1e6,"tid":0},
    {"name":"split","cat":"serial","ph":"X","ts":0,"dur":1e6,"tid":0},
    {"name":"leaf","cat":"something else","ph":"X","ts":0,"dur":1}
    ],"otherData":{"version":"1","threads":3},"displayTimeUnit":"ms"})");
  CHECK(trace.threads == 3);
  REQUIRE(trace.tasks.size() == 2);
  CHECK(trace.tasks[0].wave == 0);
  CHECK(trace.tasks[0].start == Approx(1.0000005));
  CHECK(trace.tasks[0].seconds == Approx(2.5e-7));
  CHECK(trace.tasks[1].key == pgdr::Octree_key{1, 2, 3, 2});
  CHECK(trace.tasks[1].epoch == 4);
  CHECK(trace.tasks[1].seconds == Approx(2));
  REQUIRE(trace.sections.size() == 2);
  CHECK(trace.sections[0].name == "split");
  CHECK_FALSE(trace.sections[0].parallel);
  CHECK(trace.sections[1].parallel);
  CHECK(trace.sections[1].start == Approx(2));
}

TEST_CASE("what is not a trace is refused with a reason") {
  const std::string good = R"("epoch":0,"wave":0,"level":1,"x":1,"y":0,"z":0)";
  CHECK_NOTHROW(read(with_events(leaf(good))));
  check_refused("", "parse");
  check_refused(with_events(leaf(good)) + "]", "parse");
  check_refused("{}", "traceEvents");
  check_refused(R"({"traceEvents":[]})", "threads");
  check_refused(with_events(""), "leaf task");
  check_refused(with_events(leaf(good) + "," + leaf(good, R"(,"ts":1)")), "event 2: ts or dur");
  check_refused(with_events(leaf(good, R"(,"ts":1,"dur":-1)")), "ts or dur");
  check_refused(with_events(leaf(R"("epoch":0,"wave":0,"level":1,"x":1,"y":0)")), "args.z");
  check_refused(with_events(leaf(R"("epoch":0,"wave":0,"level":1,"x":2,"y":0,"z":0)")), "outside");
  check_refused(with_events(leaf(R"("epoch":0,"wave":0,"level":21,"x":1,"y":0,"z":0)")), "level");
  check_refused(with_events(leaf(R"("epoch":0.5,"wave":0,"level":1,"x":1,"y":0,"z":0)")), "epoch");
}
