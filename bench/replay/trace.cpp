// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay/trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <istream>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

namespace pgdr::bench {

namespace {

using Json = nlohmann::json;

/// Collects the events while the parser passes over them.
class Event_handler : public nlohmann::json_sax<Json> {
 public:
  explicit Event_handler(Trace& trace) : trace_(trace) {}

  bool saw_events() const { return saw_events_; }
  bool saw_threads() const { return saw_threads_; }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool binary(binary_t&) override { return true; }

  bool string(string_t& value) override {
    if (at(event_depth, "traceEvents")) {
      if (key_ == "ph") phase_ = value;
      if (key_ == "cat") category_ = value;
      if (key_ == "name") name_ = value;
    }
    return true;
  }
  bool key(string_t& value) override {
    if (depth_ == 1) root_key_ = value;
    if (depth_ == event_depth) event_key_ = value;
    key_ = value;
    return true;
  }

  bool start_object(std::size_t) override {
    ++depth_;
    if (at(event_depth, "traceEvents")) begin_event();
    return true;
  }
  bool end_object() override {
    if (at(event_depth, "traceEvents")) end_event();
    --depth_;
    return true;
  }
  bool start_array(std::size_t) override {
    if (depth_ == 1 && root_key_ == "traceEvents") saw_events_ = true;
    ++depth_;
    return true;
  }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
    throw Trace_error(error.what());
  }

 private:
  // The root object is at depth 1, the array in it at 2, an event at 3 and its `args` at 4.
  static constexpr int event_depth = 3;
  enum Field { epoch, wave, level, x, y, z, field_count };
  static constexpr std::array<std::string_view, field_count> field_names = {"epoch", "wave", "level",
                                                                            "x",     "y",    "z"};

  bool at(int depth, std::string_view root_key) const { return depth_ == depth && root_key_ == root_key; }

  bool number(double value) {
    if (at(2, "otherData") && key_ == "threads") {
      if (!(value >= 1 && value <= 1e6)) throw Trace_error("otherData: the number of threads makes no sense");
      trace_.threads = static_cast<unsigned>(value);
      saw_threads_ = true;
    } else if (at(event_depth, "traceEvents")) {
      if (key_ == "ts") start_ = value;
      if (key_ == "dur") duration_ = value;
    } else if (at(event_depth + 1, "traceEvents") && event_key_ == "args") {
      for (std::size_t i = 0; i < field_count; ++i)
        if (key_ == field_names[i]) fields_[i] = value;
      if (key_ == "territory") is_part_ = value != 0;
    }
    return true;
  }

  void begin_event() {
    phase_.clear();
    category_.clear();
    name_.clear();
    start_.reset();
    duration_.reset();
    fields_.fill(std::nullopt);
    is_part_ = false;
  }

  void end_event() {
    ++events_;
    const bool leaf = category_ == "leaf";
    if (phase_ != "X" || (!leaf && category_ != "serial" && category_ != "parallel")) return;
    if (!start_ || !duration_) fail("ts or dur is missing");
    if (!std::isfinite(*start_) || !std::isfinite(*duration_) || *duration_ < 0)
      fail("ts or dur makes no sense");
    if (leaf)
      add_leaf();
    else
      trace_.sections.push_back({name_, 1e-6 * *start_, 1e-6 * *duration_, category_ == "parallel"});
  }

  void add_leaf() {
    std::array<std::uint32_t, field_count> value{};
    for (std::size_t i = 0; i < field_count; ++i) {
      if (!fields_[i]) fail("args." + std::string(field_names[i]) + " is missing");
      if (!(*fields_[i] >= 0 && *fields_[i] <= 4294967295.0) || std::floor(*fields_[i]) != *fields_[i])
        fail("args." + std::string(field_names[i]) + " makes no sense");
      value[i] = static_cast<std::uint32_t>(*fields_[i]);
    }
    if (value[level] > Octree_key::max_level) fail("args.level is too large");
    const std::uint32_t end = std::uint32_t{1} << value[level];
    if (value[x] >= end || value[y] >= end || value[z] >= end) fail("the leaf is outside the root");
    trace_.tasks.push_back({{value[x], value[y], value[z], static_cast<std::uint8_t>(value[level])},
                            value[epoch],
                            value[wave],
                            1e-6 * *start_,
                            1e-6 * *duration_,
                            is_part_});
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Trace_error("event " + std::to_string(events_) + ": " + what);
  }

  Trace& trace_;
  int depth_ = 0;
  std::size_t events_ = 0;
  bool saw_events_ = false, saw_threads_ = false;
  std::string root_key_, event_key_, key_, phase_, category_, name_;
  std::optional<double> start_, duration_;
  std::array<std::optional<double>, field_count> fields_{};
  bool is_part_ = false;
};

}  // namespace

Trace read_trace(std::istream& in) {
  Trace trace;
  Event_handler handler(trace);
  Json::sax_parse(in, &handler);
  if (!handler.saw_events()) throw Trace_error("there is no list traceEvents");
  if (!handler.saw_threads()) throw Trace_error("otherData.threads is missing");
  if (trace.tasks.empty()) throw Trace_error("there is no leaf task");
  std::sort(trace.tasks.begin(), trace.tasks.end(), [](const Leaf_task& a, const Leaf_task& b) {
    const auto order = [](const Leaf_task& t) { return std::tuple(t.epoch, t.wave, t.start); };
    return order(a) != order(b) ? order(a) < order(b) : precedes(a.key, b.key);
  });
  std::stable_sort(trace.sections.begin(), trace.sections.end(),
                   [](const Section& a, const Section& b) { return a.start < b.start; });
  return trace;
}

}  // namespace pgdr::bench
