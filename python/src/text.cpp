// SPDX-License-Identifier: BSD-3-Clause
// Columns of numbers as text, for JSON and CSV.
#include <charconv>
#include <cmath>
#include <cstring>

#include "bind.hpp"
#include "convert.hpp"

namespace gyrostat::python {
namespace {

/// Appends the shortest decimal that reads back as the same double, laid out as Python's repr does.
void append(std::string& text, double value) {
  if (std::isnan(value)) {
    text += "nan";  // never -nan
    return;
  }
  char digits[32];
  const double size = std::abs(value);
  const bool fixed = size == 0 || (size >= 1e-4 && size < 1e16) || std::isinf(value);
  const auto end = std::to_chars(digits, digits + sizeof digits, value,
                                 fixed ? std::chars_format::fixed : std::chars_format::scientific)
                       .ptr;
  text.append(digits, end);
  if (fixed && value == std::trunc(value) && !std::isinf(value)) text += ".0";
}

/// (n,) as an array, (n, width) as an array of arrays; null for what is not finite.
std::string json_numbers(const Array& values) {
  if (values.ndim() != 1 && values.ndim() != 2)
    raise("DomainError", "values: the shape is neither (n,) nor (n, width)");
  const py::ssize_t rows = values.shape(0), width = values.ndim() == 1 ? 1 : values.shape(1);
  const double* value = values.data();
  const py::gil_scoped_release free;
  std::string text = "[";
  text.reserve(std::size_t(values.size()) * 22 + 2);
  for (py::ssize_t row = 0; row < rows; ++row) {
    if (row > 0) text += ", ";
    if (values.ndim() == 2) text += '[';
    for (py::ssize_t i = 0; i < width; ++i, ++value) {
      if (i > 0) text += ", ";
      if (std::isfinite(*value)) append(text, *value);
      else text += "null";
    }
    if (values.ndim() == 2) text += ']';
  }
  return text += ']';
}

/// A column of a table: rows of `width` numbers, or of one word of at most `length` bytes.
struct CsvColumn {
  Array numbers;
  py::array words;
  py::ssize_t rows = 0, width = 1, length = 0;

  explicit CsvColumn(const py::array& values) {
    const bool is_words = values.dtype().kind() == 'S';
    if (is_words) words = py::array::ensure(values, py::array::c_style);
    else numbers = Array::ensure(values);
    if (values.ndim() < 1 || values.ndim() > (is_words ? 1 : 2) || !(is_words ? bool(words) : bool(numbers)))
      raise("DomainError", "columns: wanted are arrays (n,) or (n, width) of numbers, or (n,) of bytes");
    rows = values.shape(0);
    if (values.ndim() == 2) width = values.shape(1);
    if (is_words) length = values.itemsize();
  }

  void append_row(std::string& text, py::ssize_t row) const {
    if (length > 0) {
      const char* word = static_cast<const char*>(words.data()) + row * length;
      text.append(word, ::strnlen(word, std::size_t(length)));
      return;
    }
    for (py::ssize_t i = 0; i < width; ++i) {
      if (i > 0) text += ',';
      append(text, numbers.data()[row * width + i]);
    }
  }
};

/// The rows of a table, without its head.
std::string csv_rows(const py::typing::List<py::array>& given) {
  std::vector<CsvColumn> columns;
  for (const py::handle column : given) columns.emplace_back(column.cast<py::array>());
  const py::ssize_t rows = columns.empty() ? 0 : columns[0].rows;
  std::size_t numbers = 0;
  for (const CsvColumn& column : columns) {
    if (column.rows != rows) raise("DomainError", "columns: they have different numbers of rows");
    numbers += std::size_t(rows * column.width);
  }
  const py::gil_scoped_release free;
  std::string text;
  text.reserve(numbers * 21);
  for (py::ssize_t row = 0; row < rows; ++row) {
    for (const CsvColumn& column : columns) {
      if (&column != columns.data()) text += ',';
      column.append_row(text, row);
    }
    text += '\n';
  }
  return text;
}

}  // namespace
}  // namespace gyrostat::python

void bind_text(pybind11::module_& module) {
  using namespace gyrostat::python;
  module.def(
      "json_numbers", &json_numbers, py::arg("values"),
      "An array (n,) or (n, width) as JSON; every number reads back as the same double, what is not finite is null.");
  module.def("csv_rows", &csv_rows, py::arg("columns"),
             "The rows of a table of columns (n,) or (n, width) of numbers, or (n,) of bytes, as CSV without a head.");
}
