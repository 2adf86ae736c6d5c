#include "base/hdf5_series.hpp"

#include <hdf5_hl.h>

#include <algorithm>

#include "base/atomic_file.hpp"
#include "base/hdf5_file_internal.hpp"
#include "base/version.hpp"

namespace dim {

using hdf5::Handle;

namespace {

// A chunk is a month of hours of some sensors: a sensor's year and a moment of all sensors are read alike.
constexpr hsize_t kChunkRows = 730, kChunkColumns = 64;

void require_name(const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos) throw InternalError("'" + name + "' names no dataset");
}

}  // namespace

struct Hdf5Series::Impl {
  Impl(const std::string& file_name, const Job& caller) : path(file_name), on_disk(file_name, caller), job(caller) {}

  std::string path;
  AtomicFile on_disk;
  Job job;
  Handle file;
  Handle created = hdf5::timeless(H5P_DATASET_CREATE);
  Handle table;
  std::size_t n_rows = 0, n_columns = 0;

  /// What the disk refused.
  void written(bool success) const {
    if (!success) throw IoError(path, "cannot write" + hdf5::reason());
  }
  Handle make(const std::string& name, hid_t type, const Shape& shape, const Handle& properties) const;
  Handle scale(const std::string& name) const;
};

Handle Hdf5Series::Impl::make(const std::string& name, hid_t type, const Shape& shape,
                              const Handle& properties) const {
  require_name(name);
  const Handle space = hdf5::dataspace(shape);
  Handle set(H5Dcreate2(file.get(), name.c_str(), type, space.get(), H5P_DEFAULT, properties.get(), H5P_DEFAULT),
             H5Dclose);
  hdf5::require(bool(set), name);
  return set;
}

Handle Hdf5Series::Impl::scale(const std::string& name) const {
  Handle set(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose);
  hdf5::require(set && (H5DSis_scale(set.get()) > 0 || H5DSset_scale(set.get(), name.c_str()) >= 0), name);
  return set;
}

Hdf5Series::Hdf5Series(const std::string& path, const std::string& kind, int version, const Job& job)
    : impl_(std::make_unique<Impl>(path, job)) {
  hdf5::silence();
  const std::string& name = impl_->on_disk.temporary();
  if (name.empty()) throw IoError(path, "cannot write: an HDF5 file needs a regular file, not a pipe or device");
  const Handle creation = hdf5::timeless(H5P_FILE_CREATE);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  impl_->file = Handle(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  impl_->written(bool(impl_->file));
  attribute("dim_format", kind);
  const std::int64_t number = version;
  hdf5::write_value(impl_->file.get(), "/", "dim_version", H5T_NATIVE_INT64, &number);
  attribute("dim_program", dim::version());
}

Hdf5Series::~Hdf5Series() = default;

void Hdf5Series::attribute(const std::string& name, const std::string& value) {
  hdf5::write_text(impl_->file.get(), "/", name, value);
}

void Hdf5Series::numbers(const std::string& name, std::span<const double> values, const std::string& unit,
                         const std::string& description) {
  const Handle set = impl_->make(name, H5T_IEEE_F64LE, {values.size()}, impl_->created);
  impl_->written(H5Dwrite(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  hdf5::write_text(set.get(), name, "unit", unit);
  hdf5::write_text(set.get(), name, "description", description);
}

void Hdf5Series::texts(const std::string& name, const std::vector<std::string>& values,
                       const std::string& description) {
  std::size_t width = 1;
  for (const auto& value : values) width = std::max(width, value.size());
  std::vector<char> bytes(values.size() * width, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    std::ranges::copy(values[i], bytes.begin() + static_cast<std::ptrdiff_t>(i * width));
  const Handle type = hdf5::fixed_string_type(width);
  const Handle set = impl_->make(name, type.get(), {values.size()}, impl_->created);
  impl_->written(H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) >= 0);
  hdf5::write_text(set.get(), name, "unit", "1");
  hdf5::write_text(set.get(), name, "description", description);
}

void Hdf5Series::table(const std::string& name, const std::string& row_scale, const std::string& column_scale,
                       const std::string& unit, const std::string& description) {
  const Handle scales[] = {impl_->scale(row_scale), impl_->scale(column_scale)};
  const auto length = [](const Handle& scale) {
    const Handle space(H5Dget_space(scale.get()), H5Sclose);
    return static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get()));
  };
  impl_->n_rows = length(scales[0]);
  impl_->n_columns = length(scales[1]);
  const Handle properties = hdf5::timeless(H5P_DATASET_CREATE);
  const hsize_t chunk[] = {std::clamp<hsize_t>(impl_->n_rows, 1, kChunkRows),
                           std::clamp<hsize_t>(impl_->n_columns, 1, kChunkColumns)};
  H5Pset_chunk(properties.get(), 2, chunk);
  impl_->table = impl_->make(name, H5T_IEEE_F32LE, {impl_->n_rows, impl_->n_columns}, properties);
  hdf5::write_text(impl_->table.get(), name, "unit", unit);
  hdf5::write_text(impl_->table.get(), name, "description", description);
  const std::string labels[] = {row_scale, column_scale};
  for (unsigned i = 0; i < 2; ++i)
    hdf5::require(H5DSattach_scale(impl_->table.get(), scales[i].get(), i) >= 0 &&
                      H5DSset_label(impl_->table.get(), i, labels[i].c_str()) >= 0,
                  name);
}

void Hdf5Series::columns(std::size_t first, std::size_t n, std::span<const float> values) {
  if (values.size() != n * impl_->n_rows || first + n > impl_->n_columns)
    throw InternalError("columns that the table has not");
  if (values.empty()) return;
  impl_->job.check();
  const Handle memory = hdf5::dataspace({impl_->n_rows, n});
  const Handle on_disk(H5Dget_space(impl_->table.get()), H5Sclose);
  const hsize_t start[] = {0, first}, count[] = {impl_->n_rows, n};
  H5Sselect_hyperslab(on_disk.get(), H5S_SELECT_SET, start, nullptr, count, nullptr);
  impl_->written(H5Dwrite(impl_->table.get(), H5T_NATIVE_FLOAT, memory.get(), on_disk.get(), H5P_DEFAULT,
                          values.data()) >= 0);
}

void Hdf5Series::commit() {
  // Closing the file by its handle alone would leave it open as long as the table is.
  impl_->table = Handle();
  impl_->written(H5Fflush(impl_->file.get(), H5F_SCOPE_GLOBAL) >= 0);
  impl_->file = Handle();
  impl_->on_disk.commit();
}

}  // namespace dim
