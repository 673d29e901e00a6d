// limit BENCH [THREADS]: a yardstick, not a part of flexspline. The benchmark's fit as near the
// machine's limit as one law, one formula and one size of problem allow: sizes known when compiled,
// eight loops a vector, tangents by the step's common factors, J'J on the fly, Gauss-Newton. No
// error control, no choice of formula, no statistics. Compiled for the machine it is built on.
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <Eigen/Cholesky>

namespace {

constexpr int kLanes = 8;
constexpr int kF = 3, kG = 3, kH = 2, kP = kF + kG + kH, kRows = (kP + 1) * (kP + 2) / 2;
using Number = double __attribute__((vector_size(kLanes * 8)));
using Whole = long long __attribute__((vector_size(kLanes * 8)));
using Theta = std::array<double, kP>;

Number exponential(Number x) {
  const Number shifted = x * 1.4426950408889634 + 0x1.8p52;
  const Number n = shifted - 0x1.8p52;
  const Number r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  const Number r2 = r * r, r4 = r2 * r2;
  const Number low = (1.0 + r) + r2 * (1.0 / 2 + r * (1.0 / 6));
  const Number mid = (1.0 / 24 + r * (1.0 / 120)) + r2 * (1.0 / 720 + r * (1.0 / 5040));
  const Number high = (1.0 / 40320 + r * (1.0 / 362880)) + r2 * (1.0 / 3628800);
  const Number m = low + r4 * (mid + r4 * high);
  return reinterpret_cast<Number>(reinterpret_cast<Whole>(m) +
                                  (reinterpret_cast<Whole>(shifted) << 52));
}

struct Stage {
  Number value, slope, spring, damping, growth, x2, u2;
};

inline Stage stage(const Theta& t, Number torque, Number x) {
  Stage s;
  s.x2 = x * x;
  const Number u = torque - ((t[2] * s.x2 + t[1]) * s.x2 + t[0]) * x;
  const Number f1 = (5.0 * t[2] * s.x2 + 3.0 * t[1]) * s.x2 + t[0];
  s.u2 = u * u;
  const Number h = exponential((t[7] * s.x2 + t[6]) * s.x2);
  s.damping = h * u;
  s.value = s.damping * ((t[5] * s.u2 + t[4]) * s.u2 + t[3]);
  const Number hg1 = h * ((5.0 * t[5] * s.u2 + 3.0 * t[4]) * s.u2 + t[3]);
  s.slope = s.value * ((4.0 * t[7] * s.x2 + 2.0 * t[6]) * x) - hg1 * f1;
  s.spring = -hg1 * x;
  s.growth = s.value * s.x2;
  return s;
}

/// Eight loops: torque at every half step, motions, one over the peak, width of a step.
struct Block {
  int parts = 1;
  long samples = 0;
  std::vector<Number> torque, motion;
  Number weight{}, width{};
};

void evaluate(const Block& block, const Theta& theta, Number* sums) {
  for (int k = 0; k < kRows; ++k) sums[k] = Number{};
  Number x{}, s[kP] = {};
  const Number h = block.width, half = 0.5 * h, sixth = h * (1.0 / 6.0);
  const Number* torque = block.torque.data();
  for (long n = 0; n < block.samples; ++n) {
    for (int part = 0; part < block.parts; ++part, torque += 2) {
      const Stage a = stage(theta, torque[0], x);
      const Stage b = stage(theta, torque[1], x + half * a.value);
      const Stage c = stage(theta, torque[1], x + half * b.value);
      const Stage d = stage(theta, torque[2], x + h * c.value);
      x += sixth * (a.value + 2.0 * (b.value + c.value) + d.value);
      const Number wd = sixth, wc = 2.0 * sixth + wd * d.slope * h;
      const Number wb = 2.0 * sixth + wc * c.slope * half, wa = sixth + wb * b.slope * half;
      const Number keep = 1.0 + wa * a.slope + wb * b.slope + wc * c.slope + wd * d.slope;
      const auto advance = [&](int first, int count, Number Stage::*base, Number Stage::*square) {
        Number pa = wa * a.*base, pb = wb * b.*base, pc = wc * c.*base, pd = wd * d.*base;
        for (int k = first; k < first + count; ++k) {
          s[k] = keep * s[k] + ((pa + pb) + (pc + pd));
          pa *= a.*square, pb *= b.*square, pc *= c.*square, pd *= d.*square;
        }
      };
      advance(0, kF, &Stage::spring, &Stage::x2);
      advance(kF, kG, &Stage::damping, &Stage::u2);
      advance(kF + kG, kH, &Stage::growth, &Stage::x2);
    }
    Number row[kP + 1];
    for (int k = 0; k < kP; ++k) row[k] = block.weight * s[k];
    row[kP] = block.weight * (x - block.motion[static_cast<std::size_t>(n)]);
    for (int i = 0, at = 0; i <= kP; ++i) {
      for (int k = 0; k <= i; ++k) sums[at++] += row[i] * row[k];
    }
  }
}

struct Loops {
  int loops = 0, samples = 0;
  double cycles = 0.0;
  Theta guess{};
  std::vector<double> amplitude, frequency, peak;
  std::vector<std::vector<double>> motion;
};

Loops read(const std::string& folder) {
  Loops all;
  int sizes[3];
  double ignored;
  std::ifstream meta(folder + "/meta.txt");
  meta >> all.loops >> all.samples >> all.cycles >> sizes[0] >> sizes[1] >> sizes[2];
  for (int k = 0; k < kP; ++k) meta >> ignored;
  for (double& g : all.guess) meta >> g;
  std::string line;
  std::ifstream loops(folder + "/loops.csv");
  std::getline(loops, line);
  double a, f, p;
  int loop;
  while (std::getline(loops, line) &&
         std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &loop, &a, &f, &p) == 4) {
    all.amplitude.push_back(a), all.frequency.push_back(f), all.peak.push_back(p);
  }
  all.motion.resize(all.peak.size());
  std::ifstream samples(folder + "/samples.csv");
  std::getline(samples, line);
  while (std::getline(samples, line) &&
         std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &loop, &f, &a, &p) == 4) {
    all.motion[static_cast<std::size_t>(loop)].push_back(p);
  }
  return all;
}

Block pack(const Loops& all, std::size_t first) {
  Block block;
  block.samples = all.samples;
  double longest = 0.0;
  for (std::size_t k = first; k < std::min(first + kLanes, all.peak.size()); ++k) {
    longest = std::max(longest, all.cycles / all.frequency[k] / all.samples);
  }
  block.parts = std::max(1, static_cast<int>(std::ceil(longest * 40.0)));
  const auto half_steps = static_cast<std::size_t>(2 * all.samples * block.parts);
  block.torque.resize(half_steps + 1);
  block.motion.resize(static_cast<std::size_t>(all.samples));
  for (int lane = 0; lane < kLanes; ++lane) {
    const bool used = first + static_cast<std::size_t>(lane) < all.peak.size();
    const std::size_t k = used ? first + static_cast<std::size_t>(lane) : first;
    block.weight[lane] = used ? 1.0 / all.peak[k] : 0.0;
    block.width[lane] = all.cycles / all.frequency[k] / all.samples / block.parts;
    for (std::size_t j = 0; j <= half_steps; ++j) {
      const double turns = all.cycles * static_cast<double>(j) / static_cast<double>(half_steps);
      block.torque[j][lane] = all.amplitude[k] * std::sin(2.0 * std::numbers::pi * turns);
    }
    for (std::size_t n = 0; n < block.motion.size(); ++n) {
      block.motion[n][lane] = all.motion[k][n + 1];
    }
  }
  return block;
}

using Matrix = Eigen::Matrix<double, kP + 1, kP + 1>;

Matrix normal(const std::vector<Block>& blocks, const Theta& theta, int threads) {
  std::vector<std::array<Number, kRows>> sums(blocks.size());
  const auto work = [&](std::size_t first) {
    for (std::size_t b = first; b < blocks.size(); b += static_cast<std::size_t>(threads)) {
      evaluate(blocks[b], theta, sums[b].data());
    }
  };
  std::vector<std::jthread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(work, static_cast<std::size_t>(t));
  work(0);
  others.clear();
  Matrix m = Matrix::Zero();
  for (const auto& each : sums) {
    for (int i = 0, at = 0; i <= kP; ++i) {
      for (int k = 0; k <= i; ++k, ++at) {
        for (int lane = 0; lane < kLanes; ++lane)
          m(i, k) += each[static_cast<std::size_t>(at)][lane];
      }
    }
  }
  return m.selfadjointView<Eigen::Lower>();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const Loops all = read(argv[1]);
  const int threads = argc > 2 ? std::atoi(argv[2]) : 2;
  const auto started = std::chrono::steady_clock::now();
  std::vector<Block> blocks;
  for (std::size_t k = 0; k < all.peak.size(); k += kLanes) blocks.push_back(pack(all, k));
  const auto packed = std::chrono::steady_clock::now();
  Theta theta = all.guess;
  Matrix at = normal(blocks, theta, threads);
  double damping = 1e-3;
  int evaluations = 1;
  for (; evaluations < 100; ++evaluations) {
    Eigen::Matrix<double, kP, kP> a = at.topLeftCorner<kP, kP>();
    a.diagonal() *= 1.0 + damping;
    const Eigen::Matrix<double, kP, 1> step = a.ldlt().solve(-at.col(kP).head<kP>());
    if (-step.dot(at.col(kP).head<kP>()) < 1e-10 * at(kP, kP)) break;
    Theta next = theta;
    for (std::size_t k = 0; k < kP; ++k) next[k] += step[static_cast<Eigen::Index>(k)];
    const Matrix there = normal(blocks, next, threads);
    const bool better = there(kP, kP) < at(kP, kP);
    damping *= better ? 0.1 : 10.0;
    if (better) theta = next, at = there;
  }
  const auto done = std::chrono::steady_clock::now();
  const auto seconds = [&](auto from) {
    return std::chrono::duration<double>(done - from).count();
  };
  std::printf(
      "{\"peer\": \"limit_%d\", \"wall_s\": %.6g, \"fit_s\": %.6g, \"evaluations\": %d, \"theta\": "
      "[",
      threads, seconds(started), seconds(packed), evaluations);
  for (std::size_t k = 0; k < kP; ++k) std::printf("%s%.17g", k > 0 ? ", " : "", theta[k]);
  std::printf("]}\n");
  return 0;
}
