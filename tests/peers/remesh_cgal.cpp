// Remeshes an OBJ file with CGAL: remesh_cgal SOURCE TARGET LENGTH. Prints the seconds.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <chrono>
#include <fstream>
#include <iostream>

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
namespace processing = CGAL::Polygon_mesh_processing;

int main(int, char **words) {
    Mesh mesh;
    if (!processing::IO::read_polygon_mesh(words[1], mesh))
        return 1;
    const auto start = std::chrono::steady_clock::now();
    const auto options = processing::parameters::number_of_iterations(10);
    processing::isotropic_remeshing(faces(mesh), std::atof(words[3]), mesh, options);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::cout << seconds.count() << std::endl;
    mesh.collect_garbage();
    std::ofstream target(words[2]);
    target.precision(17);
    CGAL::IO::write_OBJ(target, mesh);
}
