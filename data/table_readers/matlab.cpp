#include <fmt/format.h>

#include <memory>

#include "flexspline/data/table_reader.hpp"
#include "tables/column_block.hpp"
#include "tables/mat_tables.hpp"

namespace flexspline::data {
namespace {

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};

bool knows(std::string_view head) {
  return head.starts_with("MATLAB 5.0 MAT-file") || head.starts_with("MATLAB 7.0 MAT-file");
}

Result<void> refused(const std::filesystem::path& path, const std::string& why) {
  return failure(ErrorCode::bad_data, fmt::format("{}: {}", path.string(), why),
                 "the file may be cut or damaged; save it again, with save -v7");
}

Result<void> read(const std::filesystem::path& path, const TableRequest& request, TableSink& sink) {
  const std::unique_ptr<mat_t, CloseFile> file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) return refused(path, "matio cannot open it");
  MatTables tables(request.limits);
  std::size_t variables = 0;
  while (matvar_t* next = Mat_VarReadNext(file.get())) {
    const std::unique_ptr<matvar_t, FreeVariable> variable(next);
    if (++variables > request.limits.columns) return refused(path, "it has too many variables");
    tables.take(MatVariable(variable.get()));
  }
  if (variables == 0) return refused(path, "it has no variable that can be read");
  const std::vector<std::string> notes = tables.notes();
  for (const MatTable& one : std::move(tables).tables()) tell_table(one.head, one.columns, sink);
  for (const std::string& note : notes) sink.note(note);
  return {};
}

}  // namespace

TableReaderRow describe_matlab() {
  return {.id = "matlab",
          .says =
              "MATLAB v5 and v7: vectors, matrices, structs and arrays of them, timeseries "
              "and timetables saved as structs, dSPACE's X and Y, Simulink's structure with time",
          .by_others = true,
          .knows = knows,
          .read = read};
}

}  // namespace flexspline::data
