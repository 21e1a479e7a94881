// Measures how long Pixar's OpenSubdiv takes to refine meshes uniformly: the topology, and the positions in double
// precision. OpenSubdiv uses one thread.
//
//     g++ -std=c++17 -O2 bench.cpp -losdCPU -o bench && ./bench
//
// Each output line after the first describes five runs, which follow one warm-up run: their median, minimum and maximum
// time in seconds, and the peak resident memory. Each line is measured in a separate process, so that its peak memory
// does not include other runs. "create" is the time to build the connectivity of the coarse mesh. "refine" is the time
// to build the connectivity of all levels. "positions" is the time to compute the positions of all levels, each in a
// newly allocated vector.

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <vector>

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;

namespace {

struct Point {
    double x = 0.0, y = 0.0, z = 0.0;

    void Clear() { x = y = z = 0.0; }

    void AddWithWeight(Point const& p, double weight) {
        x += weight * p.x;
        y += weight * p.y;
        z += weight * p.z;
    }
};

struct Cage {
    std::vector<Point> positions;
    std::vector<int> degrees, corners;

    void face(std::initializer_list<int> vertices) {
        degrees.push_back(int(vertices.size()));
        corners.insert(corners.end(), vertices);
    }
};

Cage icosahedron() {
    double const a = 1.0 / std::sqrt(1.0 + 1.618033988749895 * 1.618033988749895);
    double const b = 1.618033988749895 * a;
    Cage cage;
    cage.positions = {{-a, b, 0}, {a, b, 0}, {-a, -b, 0}, {a, -b, 0}, {0, -a, b}, {0, a, b},
                      {0, -a, -b}, {0, a, -b}, {b, 0, -a}, {b, 0, a}, {-b, 0, -a}, {-b, 0, a}};
    std::array<int, 60> const faces = {0, 11, 5, 0, 5,  1,  0,  1,  7, 0,  7,  10, 0, 10, 11,
                                       1, 5,  9, 5, 11, 4,  11, 10, 2, 10, 7,  6,  7, 1,  8,
                                       3, 9,  4, 3, 4,  2,  3,  2,  6, 3,  6,  8,  3, 8,  9,
                                       4, 9,  5, 2, 4,  11, 6,  2,  10, 8, 6,  7,  9, 8,  1};
    for (int i = 0; i < 60; i += 3) cage.face({faces[i], faces[i + 1], faces[i + 2]});
    return cage;
}

/// Returns a torus of m by n quads. Some quads are cut into two triangles: with `every` = 3, for example, each third
/// quad.
Cage torus(int m, int n, int every) {
    double const turn = 6.283185307179586;
    Cage cage;
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j < n; ++j) {
            double const a = turn * i / m, b = turn * j / n;
            double const r = 2.0 + std::cos(b);
            cage.positions.push_back({r * std::cos(a), r * std::sin(a), std::sin(b)});
        }
    }
    auto const at = [m, n](int i, int j) { return (i % m) * n + j % n; };
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j < n; ++j) {
            int const a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            if ((i * n + j) % every == 0) {
                cage.face({a, b, c});
                cage.face({a, c, d});
            } else {
                cage.face({a, b, c, d});
            }
        }
    }
    return cage;
}

double now() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

struct Seconds {
    double create, refine, positions;

    double all() const { return create + refine + positions; }
};

Seconds once(Cage const& cage, Sdc::SchemeType scheme, int levels, bool full, double& sum) {
    double const start = now();
    Far::TopologyDescriptor mesh;
    mesh.numVertices = int(cage.positions.size());
    mesh.numFaces = int(cage.degrees.size());
    mesh.numVertsPerFace = cage.degrees.data();
    mesh.vertIndicesPerFace = cage.corners.data();
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    std::unique_ptr<Far::TopologyRefiner> const refiner(
        Factory::Create(mesh, Factory::Options(scheme, options)));

    double const created = now();
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = full;
    refiner->RefineUniform(uniform);

    double const refined = now();
    Far::PrimvarRefinerReal<double> const values(*refiner);
    std::vector<Point> positions;
    for (int i = 1; i <= levels; ++i) {
        std::vector<Point> next(refiner->GetLevel(i).GetNumVertices());
        values.Interpolate(i, i == 1 ? cage.positions : positions, next);
        positions.swap(next);
    }
    double const done = now();

    // The program prints the sum of the results, so that the compiler cannot remove the computation.
    for (Point const& p : positions) sum += p.x + p.y + p.z;
    sum += refiner->GetLevel(levels).GetNumFaces();
    return {created - start, refined - created, done - refined};
}

void run(char const* name, Cage const& cage, Sdc::SchemeType scheme, int levels, bool full) {
    std::fflush(stdout);
    pid_t const child = fork();
    if (child != 0) {
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) < 0 || status != 0) std::exit(1);
        return;
    }
    double sum = 0.0;
    std::vector<Seconds> runs;
    for (int i = 0; i < 6; ++i) {
        Seconds const seconds = once(cage, scheme, levels, full, sum);
        if (i > 0) runs.push_back(seconds);
    }
    std::sort(runs.begin(), runs.end(), [](Seconds const& a, Seconds const& b) { return a.all() < b.all(); });
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    Seconds const& median = runs[2];
    std::printf("%-36s %-4s %7.3f s (%.3f to %.3f): create %.3f, refine %.3f, positions %.3f; %5ld MB\n", name,
                full ? "full" : "last", median.all(), runs[0].all(), runs[4].all(), median.create,
                median.refine, median.positions, usage.ru_maxrss / 1024);
    std::fprintf(stderr, "%s: sum %.6f\n", name, sum);
    std::fflush(stdout);
    _exit(0);
}

}  // namespace

int main() {
    std::printf("OpenSubdiv, one thread; full: all connectivity of the last level, last: only the vertices of its faces\n");
    // "last" stores only the vertices of each face of the last level, as a viewer needs them. "full" stores all
    // connectivity of the last level, as an editable mesh needs it.
    for (bool full : {false, true}) {
        run("loop, icosahedron, 9 levels", icosahedron(), Sdc::SCHEME_LOOP, 9, full);
        run("loop, 100352 triangles, 3 levels", torus(224, 224, 1), Sdc::SCHEME_LOOP, 3, full);
        run("catmull-clark, 33451 faces, 3 levels", torus(224, 112, 3), Sdc::SCHEME_CATMARK, 3, full);
    }
}
