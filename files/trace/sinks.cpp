// SPDX-License-Identifier: Apache-2.0
#include "files/trace/sinks.hpp"

#include <memory>
#include <utility>

#include "files/trace/csv_writer.hpp"
#include "files/trace/mat_writer.hpp"
#include "files/trace/vcd_writer.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "text/results/json_summary.hpp"

namespace files {
namespace {

/// A sink for any file. `facts` compute the arguments of commit() from the run.
template <class File, class... Facts>
Sink sink_of(const std::shared_ptr<File>& file, Facts (*... facts)(const RunStory&)) {
  Sink sink;
  sink.failed = [file] { return file->failed(); };
  sink.finish = [file, facts...](const RunStory& s, bool whole) {
    return whole ? file->commit(facts(s)...) : file->commit_partial(facts(s)...);
  };
  return sink;
}

std::uint64_t digest_of(const RunStory& s) { return s.outcome.digest; }

base::Result<Sink> any_mat_sink(const Destination& to, const study::Scenario& scenario,
                                const TraceOrigin& origin, MatVersion version) {
  base::Result<std::vector<study::Column>> columns = study::record_columns(scenario);
  if (!columns) return columns.problems();
  base::Result<MatWriter> made = MatWriter::create(to, *columns, version, origin);
  if (!made) return made.problems();
  const auto file = std::make_shared<MatWriter>(std::move(*made));
  Sink sink = sink_of(file, digest_of);
  sink.on_record = [file](study::Row row) { file->row(row); };
  return sink;
}

}  // namespace

base::Result<Sink> csv_sink(const Destination& to, const study::Scenario& scenario,
                            const TraceOrigin& origin) {
  base::Result<std::vector<study::Column>> columns = study::record_columns(scenario);
  if (!columns) return columns.problems();
  base::Result<CsvWriter> made = CsvWriter::create(to, *columns, origin_lines(origin));
  if (!made) return made.problems();
  const auto file = std::make_shared<CsvWriter>(std::move(*made));
  Sink sink = sink_of(file);
  sink.on_record = [file](study::Row row) { file->row(row); };
  return sink;
}

base::Result<Sink> mat_sink(const Destination& to, const study::Scenario& scenario,
                            const TraceOrigin& origin) {
  return any_mat_sink(to, scenario, origin, MatVersion::v5);
}

base::Result<Sink> mat73_sink(const Destination& to, const study::Scenario& scenario,
                              const TraceOrigin& origin) {
  return any_mat_sink(to, scenario, origin, MatVersion::v7_3);
}

base::Result<Sink> vcd_sink(const Destination& to, const study::Scenario&, const TraceOrigin& origin) {
  base::Result<VcdWriter> made = VcdWriter::create(to, study::logic_signals(), origin);
  if (!made) return made.problems();
  const auto file = std::make_shared<VcdWriter>(std::move(*made));
  Sink sink = sink_of(file);
  sink.on_logic = [file](std::int64_t ps, std::span<const std::uint32_t> row) { file->change(ps, row); };
  return sink;
}

base::Result<Sink> page_sink(const Destination& to, std::function<std::string(const RunStory&)> page) {
  base::Result<AtomicFile> made = AtomicFile::create(to);
  if (!made) return made.problems();
  const auto file = std::make_shared<AtomicFile>(std::move(*made));
  Sink sink = sink_of(file);
  sink.finish = [file, page = std::move(page)](const RunStory& s, bool whole) {
    file->write(page(s));
    return whole ? file->commit() : file->commit_partial();
  };
  return sink;
}

base::Result<Sink> json_sink(const Destination& to, const study::Scenario&, const TraceOrigin&) {
  return page_sink(to, [](const RunStory& s) { return text::json_summary(s.scenario, s.outcome); });
}

}  // namespace files
