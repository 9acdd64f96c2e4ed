// SPDX-License-Identifier: GPL-3.0-or-later
#include "replay/prediction.h"

#include <algorithm>
#include <span>
#include <string>

#include "replay/list_schedule.h"
#include "replay/wave_graph.h"

namespace pgdr::bench {

namespace {

struct Span_of_time {
  double start, end;
  std::string name;
};

/// The time that is in none of the spans, which must follow one another.
double time_between(std::vector<Span_of_time>& spans) {
  std::sort(spans.begin(), spans.end(), [](const Span_of_time& a, const Span_of_time& b) {
    return a.start != b.start ? a.start < b.start : a.end < b.end;
  });
  double gaps = 0, end = spans.front().end;
  for (std::size_t i = 1; i < spans.size(); ++i) {
    if (spans[i].start < end - 2e-6)
      throw Trace_error(spans[i].name + " begins before " + spans[i - 1].name + " has ended");
    gaps += std::max(0.0, spans[i].start - end);
    end = std::max(end, spans[i].end);
  }
  return gaps;
}

}  // namespace

Replay replay(const Trace& trace, const std::vector<std::size_t>& workers) {
  Replay result;
  for (std::size_t p : workers) result.predictions.push_back({p, 0, 1, 1});
  double one_worker = 0, wave_path = 0;
  std::vector<Span_of_time> spans;

  const std::span<const Leaf_task> all(trace.tasks);
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    const std::uint32_t epoch = all[begin].epoch, wave = all[begin].wave;
    Span_of_time span{all[begin].start, all[begin].start,
                      "wave " + std::to_string(wave) + " of epoch " + std::to_string(epoch)};
    double work = 0;
    for (; end < all.size() && all[end].epoch == epoch && all[end].wave == wave; ++end) {
      work += all[end].seconds;
      span.end = std::max(span.end, all[end].start + all[end].seconds);
    }
    const Wave_graph graph = make_wave_graph(all.subspan(begin, end - begin));
    const Wave_width width = wave_width(graph);

    ++result.waves;
    result.edges += graph.successors.size();
    result.leaf_work += work;
    result.overhead += std::max(0.0, trace.threads * (span.end - span.start) - work);
    result.ready_max = std::max(result.ready_max, width.ready_max);
    wave_path += width.critical_path;
    one_worker += work;
    for (Prediction& p : result.predictions)
      p.seconds += p.workers == 1 ? work : list_schedule(graph, p.workers);
    spans.push_back(std::move(span));

    if (result.epochs.empty() || result.epochs.back().epoch != epoch)
      result.epochs.push_back({epoch, 0, 0, 0, 0, 0});
    Epoch_figures& figures = result.epochs.back();
    ++figures.waves;
    figures.tasks += graph.size();
    figures.work += work;
    figures.critical_path += width.critical_path;
    figures.ready_max = std::max(figures.ready_max, width.ready_max);
  }

  for (const Section& section : trace.sections) {
    spans.push_back({section.start, section.start + section.seconds, "section \"" + section.name + "\""});
    if (section.parallel)
      result.parallel_work += trace.threads * section.seconds;
    else
      result.serial += section.seconds;
  }
  if (spans.empty()) throw Trace_error("the trace is empty");
  result.unrecorded = time_between(spans);

  double last = spans.front().end;
  for (const Span_of_time& span : spans) last = std::max(last, span.end);
  result.recorded = last - spans.front().start;
  result.tasks = trace.tasks.size();
  const double serial = result.serial + result.unrecorded;
  result.serial_share = result.recorded > 0 ? serial / result.recorded : 0;
  result.critical_path = serial + wave_path;
  result.ready_mean = wave_path > 0 ? result.leaf_work / wave_path : 0;
  one_worker += serial + result.parallel_work;
  for (Prediction& p : result.predictions) {
    p.seconds += serial + result.parallel_work / static_cast<double>(p.workers);
    p.speed_up = p.seconds > 0 ? one_worker / p.seconds : 1;
    p.efficiency = p.speed_up / static_cast<double>(p.workers);
  }
  return result;
}

}  // namespace pgdr::bench
