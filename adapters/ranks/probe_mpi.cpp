// SPDX-License-Identifier: GPL-2.0-only
// What `engine-tripoint-mpi --probe` times: the calls that a step over ranks makes, alone.
#include <mpi.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>
#include <vector>

#include "adapters/ranks/ranks.hpp"

namespace {

constexpr double seconds_of_each = 0.4;  ///< of wall time

/// Seconds of one call: the least over rounds of a few calls, of each round the longer of both ranks. A round
/// in which another program had its turn does not count, nor one that ended soon because the other rank had
/// begun before.
template <class Call>
double best_of(Call call) {
  constexpr int each = 5;
  double best = std::numeric_limits<double>::infinity();
  const double end = MPI_Wtime() + seconds_of_each;
  for (int go_on = 1; go_on != 0;) {
    const double begin = MPI_Wtime();
    for (int n = 0; n < each; ++n) call();
    const double took = (MPI_Wtime() - begin) / each;
    double longer = took;
    MPI_Allreduce(&took, &longer, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    best = std::min(best, longer);
    go_on = MPI_Wtime() < end ? 1 : 0;
    MPI_Bcast(&go_on, 1, MPI_INT, 0, MPI_COMM_WORLD);  // both make as many rounds
  }
  return best;
}

/// Both ranks send and take at once, as neighbours do.
double exchange(int bytes, int other) {
  std::vector<char> out(static_cast<std::size_t>(bytes)), in(out.size());
  return best_of([&] {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Irecv(in.data(), bytes, MPI_CHAR, other, 0, MPI_COMM_WORLD, &request);
    MPI_Send(out.data(), bytes, MPI_CHAR, other, 0, MPI_COMM_WORLD);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  });
}

double allreduce(int count) {
  std::vector<double> in(static_cast<std::size_t>(count), 1.0), out(in.size());
  return best_of([&] { MPI_Allreduce(in.data(), out.data(), count, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD); });
}

/// Bytes a second of numbers that are gathered from scattered places, as the columns of ghosts are.
double pack_rate() {
  constexpr std::size_t count = 1 << 16, apart = 7;
  std::vector<double> from(count * apart, 1.0), to(count);
  double checked = 0.0;
  const double seconds = best_of([&] {
    for (std::size_t n = 0; n < count; ++n) to[n] = from[n * apart];
    checked += to[count / 2];
  });
  return checked > 0.0 ? static_cast<double>(count * sizeof(double)) / seconds : 0.0;
}

void write(const char* path, const std::vector<int>& sizes, const std::vector<double>& exchanges, double one,
           double thousand, double pack) {
  std::FILE* file = std::fopen(path, "w");
  if (!file) return;
  std::fprintf(file, "{\"ranks\": 2, \"mpi\": \"%s\", \"exchanges\": [",
               tripoint_found(nullptr)->mpi.c_str());
  for (std::size_t n = 0; n < sizes.size(); ++n)
    std::fprintf(file, "%s{\"bytes\": %d, \"seconds\": %.6e}", n > 0 ? ", " : "", sizes[n], exchanges[n]);
  std::fprintf(file,
               "], \"allreduce\": [{\"doubles\": 1, \"seconds\": %.6e}, {\"doubles\": 1024, \"seconds\": "
               "%.6e}], \"pack_rate\": %.6e}\n",
               one, thousand, pack);
  std::fclose(file);
}

}  // namespace

/// Called on each of two ranks; rank 0 writes. @return 0, or 1 where there are not two
extern "C" int tripoint_probe(const char* path) {
  MPI_Init(nullptr, nullptr);
  int code = 1;
  if (tripoint_size() == 2) {
    const std::vector<int> sizes{8, 1024, 8192, 65536, 1 << 20, 1 << 23};
    std::vector<double> exchanges;
    for (const int bytes : sizes) exchanges.push_back(exchange(bytes, 1 - tripoint_rank()));
    const double one = allreduce(1), thousand = allreduce(1024), pack = pack_rate();
    if (tripoint_rank() == 0) write(path, sizes, exchanges, one, thousand, pack);
    code = 0;
  }
  MPI_Finalize();
  return code;
}
