#include "tables/foreign_form.hpp"

#include <array>

namespace flexspline::data {
namespace {

using namespace std::string_view_literals;

struct Mark {
  std::string_view bytes;
  ForeignForm form;
};

constexpr std::array<Mark, 12> kMarks = {{
    {"PK\x03\x04"sv,
     {"a workbook of Excel (.xlsx) or another zip archive",
      "in Excel: File > Save As > CSV UTF-8, one file a sheet; or unpack the archive"}},
    {"\xD0\xCF\x11\xE0"sv,
     {"an old workbook of Excel (.xls)", "in Excel: File > Save As > CSV UTF-8, one file a sheet"}},
    {"PAR1"sv,
     {"Parquet", "python3 -c \"import pandas; pandas.read_parquet('in').to_csv('out.csv')\""}},
    {"TDSm"sv,
     {"LabVIEW's TDMS", "python3 -m nptdms.tdmsinfo lists it; export it as CSV from DIAdem"}},
    {"\x1F\x8B"sv, {"compressed by gzip", "gunzip it"}},
    {"BZh"sv, {"compressed by bzip2", "bunzip2 it"}},
    {"\xFD"
     "7zXZ"sv,
     {"compressed by xz", "unxz it"}},
    {"\x28\xB5\x2F\xFD"sv, {"compressed by zstd", "unzstd it"}},
    {"#ROSBAG"sv, {"a rosbag of ROS 1", "rostopic echo -b FILE -p /joint_states > out.csv"}},
    {"UnFinMF "sv, {"an MDF that was not closed", "open and save it where it was measured"}},
    {"MDF     3"sv, {"MDF 3", "convert it to MDF 4 where it was measured, or export it as CSV"}},
    {"%PDF"sv, {"a PDF", "give the file of numbers it was made from"}},
}};

}  // namespace

std::optional<ForeignForm> foreign_form(std::string_view head) {
  for (const Mark& mark : kMarks) {
    if (head.starts_with(mark.bytes)) return mark.form;
  }
  return std::nullopt;
}

}  // namespace flexspline::data
