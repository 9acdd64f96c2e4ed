// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_file.h"

#include <cstddef>
#include <cstdio>

#include <pgdr/io/atomic_file.h>

namespace pgdr::app {

namespace {

// Not by a JSON library: a large run has millions of tasks, and the names are our own.
int format_event(char* line, std::size_t size, const Task_record& r) {
  const double start = 1e6 * r.start, length = 1e6 * r.seconds;
  if (r.kind == Task_record::Kind::leaf)
    return std::snprintf(line, size,
                         "{\"name\":\"leaf\",\"cat\":\"leaf\",\"ph\":\"X\",\"pid\":1,\"tid\":%u,\"ts\":%.3f,"
                         "\"dur\":%.3f,\"args\":{\"epoch\":%u,\"wave\":%u,\"level\":%u,\"x\":%u,\"y\":%u,\"z\":%u,"
                         "\"inserted\":%u,\"territory\":%u}}",
                         unsigned{r.thread}, start, length, r.epoch, r.wave, unsigned{r.level}, r.x, r.y, r.z,
                         r.inserted, unsigned{r.territory});
  return std::snprintf(line, size,
                       "{\"name\":\"%s\",\"cat\":\"%s\",\"ph\":\"X\",\"pid\":1,\"tid\":%u,\"ts\":%.3f,\"dur\":%.3f}",
                       r.name, r.kind == Task_record::Kind::serial ? "serial" : "parallel", unsigned{r.thread}, start,
                       length);
}

}  // namespace

void write_trace(const Schedule_statistics& schedule, const std::filesystem::path& path) {
  Atomic_file file(path);
  char line[400];
  int n = std::snprintf(line, sizeof line,
                        "{\"displayTimeUnit\":\"ms\",\"otherData\":{\"threads\":%u,\"root_lower\":[%.17g,%.17g,%.17g],"
                        "\"root_edge\":%.17g},\"traceEvents\":[\n",
                        schedule.threads, schedule.root_lower[0], schedule.root_lower[1], schedule.root_lower[2],
                        schedule.root_edge);
  file.write(line, static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < schedule.records.size(); ++k) {
    n = format_event(line, sizeof line, schedule.records[k]);
    file.write(line, static_cast<std::size_t>(n));
    file.write(k + 1 < schedule.records.size() ? ",\n" : "\n");
  }
  file.write("]}\n");
  file.commit();
}

}  // namespace pgdr::app
