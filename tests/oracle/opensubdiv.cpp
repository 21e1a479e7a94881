// Subdivides one case with Pixar's OpenSubdiv, as a reference for the crate `subdivision`.
//
//     g++ -std=c++17 -O2 opensubdiv.cpp -losdCPU -o opensubdiv
//     ./opensubdiv cases/loop_closed.txt > results/loop_closed.txt
//
// README.md describes the case and result files.

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

using Refiner = Far::TopologyRefiner;
using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;

namespace {

/// A value of N numbers, with the two methods that OpenSubdiv needs to refine it.
template <int N>
struct Value {
    std::array<double, N> at{};

    void Clear() { at.fill(0.0); }

    void AddWithWeight(Value const& other, double weight) {
        for (int i = 0; i < N; ++i) at[i] += weight * other.at[i];
    }
};

using Points = std::vector<Value<3>>;
using Uvs = std::vector<Value<2>>;

[[noreturn]] void fail(std::string const& why) {
    std::cerr << why << "\n";
    std::exit(1);
}

/// The contents of a case file.
struct Case {
    Sdc::SchemeType scheme = Sdc::SCHEME_CATMARK;
    Sdc::Options options;
    int levels = 1;
    bool limit = false;

    Points positions;
    Uvs uvs;
    std::vector<int> degrees, corners, uv_corners;
    std::vector<int> crease_ends, corner_vertices;
    std::vector<float> crease_sharpness, corner_sharpness;
};

template <class T>
T word_of(std::istream& line, std::map<std::string, T> const& words) {
    std::string word;
    line >> word;
    auto const found = words.find(word);
    if (found == words.end()) fail("unknown word: " + word);
    return found->second;
}

/// Reads the rest of a line `face v v v` or `face v/t v/t v/t`: vertices and uv numbers.
void read_face(std::istream& line, Case& out) {
    int n = 0;
    for (std::string corner; line >> corner; ++n) {
        auto const slash = corner.find('/');
        out.corners.push_back(std::stoi(corner));
        if (slash != std::string::npos) out.uv_corners.push_back(std::stoi(corner.substr(slash + 1)));
    }
    out.degrees.push_back(n);
}

Case read(char const* path) {
    std::ifstream file(path);
    if (!file) fail(std::string("cannot read ") + path);

    Case out;
    for (std::string text; std::getline(file, text);) {
        std::istringstream line(text);
        std::string key;
        if (!(line >> key) || key[0] == '#') continue;

        if (key == "scheme") {
            out.scheme = word_of<Sdc::SchemeType>(line, {{"Loop", Sdc::SCHEME_LOOP},
                                                         {"CatmullClark", Sdc::SCHEME_CATMARK},
                                                         {"Bilinear", Sdc::SCHEME_BILINEAR}});
        } else if (key == "boundary") {
            out.options.SetVtxBoundaryInterpolation(word_of<Sdc::Options::VtxBoundaryInterpolation>(
                line, {{"EdgesOnly", Sdc::Options::VTX_BOUNDARY_EDGE_ONLY},
                       {"EdgesAndCorners", Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER}}));
        } else if (key == "creasing") {
            out.options.SetCreasingMethod(word_of<Sdc::Options::CreasingMethod>(
                line, {{"Uniform", Sdc::Options::CREASE_UNIFORM}, {"Chaikin", Sdc::Options::CREASE_CHAIKIN}}));
        } else if (key == "face_varying") {
            out.options.SetFVarLinearInterpolation(word_of<Sdc::Options::FVarLinearInterpolation>(
                line, {{"None", Sdc::Options::FVAR_LINEAR_NONE},
                       {"CornersOnly", Sdc::Options::FVAR_LINEAR_CORNERS_ONLY},
                       {"CornersPlus1", Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1},
                       {"CornersPlus2", Sdc::Options::FVAR_LINEAR_CORNERS_PLUS2},
                       {"Boundaries", Sdc::Options::FVAR_LINEAR_BOUNDARIES},
                       {"All", Sdc::Options::FVAR_LINEAR_ALL}}));
        } else if (key == "levels") {
            line >> out.levels;
        } else if (key == "limit") {
            out.limit = word_of<bool>(line, {{"yes", true}, {"no", false}});
        } else if (key == "vertex") {
            Value<3> p;
            line >> p.at[0] >> p.at[1] >> p.at[2];
            out.positions.push_back(p);
        } else if (key == "uv") {
            Value<2> uv;
            line >> uv.at[0] >> uv.at[1];
            out.uvs.push_back(uv);
        } else if (key == "face") {
            read_face(line, out);
            continue;  // Reading a face ends with a failed read at the end of the line.
        } else if (key == "crease") {
            int v, w;
            float sharpness;
            line >> v >> w >> sharpness;
            out.crease_ends.insert(out.crease_ends.end(), {v, w});
            out.crease_sharpness.push_back(sharpness);
        } else if (key == "corner") {
            int v;
            float sharpness;
            line >> v >> sharpness;
            out.corner_vertices.push_back(v);
            out.corner_sharpness.push_back(sharpness);
        } else {
            fail("unknown line: " + text);
        }
        if (!line) fail("missing numbers: " + text);
    }
    if (!out.uvs.empty() && out.uv_corners.size() != out.corners.size()) fail("a corner is missing its uv");
    return out;
}

std::unique_ptr<Refiner> refined(Case const& in) {
    Far::TopologyDescriptor mesh;
    mesh.numVertices = int(in.positions.size());
    mesh.numFaces = int(in.degrees.size());
    mesh.numVertsPerFace = in.degrees.data();
    mesh.vertIndicesPerFace = in.corners.data();
    mesh.numCreases = int(in.crease_sharpness.size());
    mesh.creaseVertexIndexPairs = in.crease_ends.data();
    mesh.creaseWeights = in.crease_sharpness.data();
    mesh.numCorners = int(in.corner_sharpness.size());
    mesh.cornerVertexIndices = in.corner_vertices.data();
    mesh.cornerWeights = in.corner_sharpness.data();

    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = int(in.uvs.size());
    channel.valueIndices = in.uv_corners.data();
    mesh.numFVarChannels = in.uvs.empty() ? 0 : 1;
    mesh.fvarChannels = &channel;

    Factory::Options options(in.scheme, in.options);
    options.validateFullTopology = true;
    std::unique_ptr<Refiner> refiner(Factory::Create(mesh, options));
    if (!refiner) fail("OpenSubdiv rejects the mesh");

    Refiner::UniformOptions uniform(in.levels);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    return refiner;
}

/// Prints numbers, each after a space. Numbers that round to zero have no sign. Numbers halfway between two decimals
/// are common. They are rounded up, even if their last bits differ between compilers.
template <int N>
void print(Value<N> const& value) {
    for (double x : value.at) {
        double const rounded = std::floor(x * 1e7 + 0.5001) / 1e7;
        std::printf(" %.7f", rounded == 0.0 ? 0.0 : rounded);
    }
}

/// Prints the sharpness of inner edges and of vertices, if it is above 0. Vertices that are corners by the boundary
/// rule are left out.
void print_sharpness(Case const& in, Far::TopologyLevel const& level) {
    bool const corners =
        in.options.GetVtxBoundaryInterpolation() == Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER;
    for (int e = 0; e < level.GetNumEdges(); ++e) {
        float const sharpness = level.GetEdgeSharpness(e);
        if (sharpness <= 0.0f || level.GetEdgeFaces(e).size() < 2) continue;
        auto const ends = level.GetEdgeVertices(e);
        std::printf("crease %d %d %.7g\n", ends[0], ends[1], double(sharpness));
    }
    for (int v = 0; v < level.GetNumVertices(); ++v) {
        float const sharpness = level.GetVertexSharpness(v);
        if (sharpness <= 0.0f || (corners && level.GetVertexFaces(v).size() == 1)) continue;
        std::printf("corner %d %.7g\n", v, double(sharpness));
    }
}

/// Prints for each vertex its limit position, two tangents, its rule and its side.
void print_limit(Far::PrimvarRefinerReal<double> const& refiner, Far::TopologyLevel const& level,
                 Points const& positions) {
    Points limit(positions.size()), tangent(positions.size()), other(positions.size());
    refiner.Limit(positions, limit, tangent, other);
    for (int v = 0; v < level.GetNumVertices(); ++v) {
        char const* rule = "none";
        switch (level.GetVertexRule(v)) {
            case Sdc::Crease::RULE_SMOOTH: rule = "smooth"; break;
            case Sdc::Crease::RULE_DART: rule = "dart"; break;
            case Sdc::Crease::RULE_CREASE: rule = "crease"; break;
            case Sdc::Crease::RULE_CORNER: rule = "corner"; break;
            default: break;
        }
        bool const boundary = level.GetVertexEdges(v).size() > level.GetVertexFaces(v).size();
        std::printf("limit");
        print(limit[v]);
        print(tangent[v]);
        print(other[v]);
        std::printf(" %s %s\n", rule, boundary ? "boundary" : "inner");
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) fail("usage: opensubdiv CASE");
    Case const in = read(argv[1]);
    auto const refiner = refined(in);
    Far::PrimvarRefinerReal<double> const values(*refiner);

    Points positions = in.positions;
    Uvs uvs = in.uvs;
    for (int i = 1; i <= in.levels; ++i) {
        auto const& level = refiner->GetLevel(i);
        Points next(level.GetNumVertices());
        values.Interpolate(i, positions, next);
        positions.swap(next);
        if (!in.uvs.empty()) {
            Uvs next_uvs(level.GetNumFVarValues());
            values.InterpolateFaceVarying(i, uvs, next_uvs);
            uvs.swap(next_uvs);
        }
    }

    auto const& level = refiner->GetLevel(in.levels);
    for (auto const& p : positions) std::printf("vertex"), print(p), std::printf("\n");
    for (auto const& uv : uvs) std::printf("uv"), print(uv), std::printf("\n");
    for (int f = 0; f < level.GetNumFaces(); ++f) {
        auto const vertices = level.GetFaceVertices(f);
        std::printf("face");
        for (int i = 0; i < vertices.size(); ++i) {
            std::printf(" %d", vertices[i]);
            if (!uvs.empty()) std::printf("/%d", level.GetFaceFVarValues(f)[i]);
        }
        std::printf("\n");
    }
    print_sharpness(in, level);
    if (in.limit) print_limit(values, level, positions);
}
