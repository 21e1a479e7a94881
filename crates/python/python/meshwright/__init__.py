'''Meshwright: a mesh editor driven by recipes.

Read a file. The result is a scene, which is a mapping from names to meshes, and `mesh()` is the only mesh:

    m = mw.read("ball.obj").mesh()

Arrays are read-only NumPy arrays. `corners` and `face_starts` describe polygons:

>>> import meshwright as mw
>>> from meshwright import choice, sel
>>> m = mw.Scene().icosahedron(name="ball").mesh()
>>> m.vertices.shape, m.triangles.shape, m.face_normals.shape
((12, 3), (20, 3), (20, 3))

Operations are methods, and return a new mesh. `help(mw.Mesh)` lists them, and `help(mw.Mesh.smooth)` describes one:

>>> m = m.weld(distance=1e-6).loop_subdivide(levels=2)

Selections are words such as "Boundary", or values of the module `sel`. To select by a Boolean mask, make a tag of it:

>>> m = m.with_attribute("top", m.vertices[:, 1] > 0.5, "vertex")
>>> m.delete_faces(faces=sel.FacesAround(sel.Tagged("top"))).is_closed
False

Other parameters with several variants take a word, or a value of the module `choice`:

>>> m = m.smooth(by=choice.Taubin(), passes=5)

Measures are properties, or attributes with a value for each vertex or face. `m.distance_to(other)` compares surfaces:

>>> round(m.area, 1), m.is_closed, m.bounds.shape
(6.5, True, (2, 3))
>>> m.measure(of="MeanCurvature", name="curvature").attributes["curvature"].shape
(162,)

A mesh can be drawn, shown in a notebook, and saved. A `LossWarning` lists the data that a file format cannot store:

    m.picture("ball.png", color_by="Area");  m.view(color_by="Area");  m.save("ball.glb")

Methods of a scene act on all of its objects, or on those that `on` names:

>>> scene = mw.Scene().cube(name="box").icosahedron(name="ball", radius=2)
>>> scene = scene.loop_subdivide(levels=1, on="ball").measure(of=choice.Distance(to="box"), name="gap", on="ball")
>>> scene["box"].n_faces, scene["ball"].n_faces, scene["ball"].attributes["gap"].shape
(6, 80, (42,))

`recipe()` returns the steps that made a mesh or a scene. The program `meshwright` runs recipes, too:

>>> print(scene["ball"].recipe())
(
    recipe: 1,
    steps: [
        Cube(name: "box"),
        Icosahedron(name: "ball", radius: 2),
        (run: LoopSubdivide(levels: 1), on: ["ball"]),
        (run: Measure(of: Distance(to: "box"), name: "gap"), on: ["ball"]),
        Delete(objects: ["box"]),
    ],
)

A recipe can also be built without running it. A recipe has the same methods as a scene, and can have parameters:

>>> r = mw.recipe().icosahedron(name="ball").loop_subdivide(levels=mw.arg("levels", int, default=1))
>>> r.run(levels=2).mesh().n_faces
320

Functions: `read`, `read_bytes`, `recipe`, `arg`, `run` and `batch`, which runs a recipe on many files.
Classes: `Mesh`, `Scene`, `Recipe`, `Outcome` and others. Use `help(mw.Mesh)` for one of them.
Modules: `sel`, `choice`, `expect` (expectations of recipes), `matrices` (sparse matrices of SciPy), `errors`.

If you know trimesh:

    trimesh                                   meshwright
    ----------------------------------------  ----------------------------------------------------------------
    trimesh.load("a.obj")                     mw.read("a.obj").mesh()
    trimesh.Trimesh(vertices, faces)          mw.Mesh.from_arrays(vertices, faces)
    mesh.vertices                             m.vertices
    mesh.export("a.stl")                      m.save("a.stl")
    mesh.faces, mesh.edges_unique             m.triangles, m.edges
    mesh.face_normals                         m.face_normals
    mesh.vertex_normals                       m.vertex_normals().attributes["normal"]
    mesh.area_faces                           m.measure(of="Area").attributes["area"]
    mesh.is_watertight, mesh.volume           m.is_closed, m.volume
    mesh.euler_number                         m.euler_characteristic
    mesh.split()                              m.scene().separate(m.name).values()
    the largest part of mesh.split()          max(m.scene().separate(m.name).values(), key=lambda p: p.n_faces)
    the part that has face 0                  m.delete_faces(faces=sel.Not(sel.Component(sel.Faces([0]))))
    trimesh.util.concatenate([a, b])          mw.Scene().with_object(a).with_object(b).join([a.name, b.name], "ab")
    mesh.update_faces(mask)                   m.delete_faces(faces=sel.Faces(np.flatnonzero(~mask)))
    mesh.merge_vertices()                     m.weld(distance=1e-8)
    mesh.apply_transform(matrix)              m.with_vertices(m.vertices @ matrix[:3, :3].T + matrix[:3, 3])
    mesh.apply_scale(2)                       m.transform(scale=(2, 2, 2))
    mesh.invert()                             m.reverse()
    mesh.fill_holes()                         m.fill_holes()
    mesh.subdivide_loop()                     m.loop_subdivide(levels=1)
    mesh.simplify_quadric_decimation()        m.simplify(faces=100)
    smoothing.filter_laplacian(mesh)          m.smooth(by=choice.Laplacian(factor=0.5), passes=10)
    smoothing.filter_taubin(mesh)             m.smooth(by=choice.Taubin(), passes=10)
    mesh.slice_plane(origin, normal)          m.bisect(normal=(0, 0, 1), keep="Front")
    mesh.sample(100)                          m.scene().scatter(surface=m.name, count=100)["points"].vertices
    mesh.contains(points)                     p.select(sel.InsideOf(m), "vertex")
    proximity.closest_point(mesh, points)     p.project(m).vertices
    proximity.signed_distance(mesh, points)   p.measure(of=choice.Distance(to=m, signed=True)).attributes["distance"]
    mesh.show()                               m.view()

Here `p = mw.Mesh.from_arrays(points, [])` is a mesh of points. Signed distances are negative inside the mesh, whereas
trimesh returns positive distances inside. `m.to_trimesh()` and `mw.Mesh.from_trimesh(mesh)` convert meshes.
'''

# With `__all__`, `help(meshwright)` would show every method of every class after this text. The imports with `as` tell
# type checkers that the names are public.
from . import choice as choice
from . import errors as errors
from . import expect as expect
from . import matrices as matrices
from . import sel as sel
from ._batch import Report as Report
from ._batch import Row as Row
from ._batch import batch as batch
from ._core import __version__ as __version__
from ._editor import Editor as Editor
from ._mesh import Attributes as Attributes
from ._mesh import Distance as Distance
from ._mesh import HalfEdges as HalfEdges
from ._mesh import Mesh as Mesh
from ._mesh import OneSided as OneSided
from ._recipe import Outcome as Outcome
from ._recipe import Parameter as Parameter
from ._recipe import Recipe as Recipe
from ._recipe import Step as Step
from ._recipe import arg as arg
from ._recipe import recipe as recipe
from ._recipe import run as run
from ._ron import Arg as Arg
from ._ron import Choice as Choice
from ._ron import Ron as Ron
from ._scene import Scene as Scene
from ._scene import read as read
from ._scene import read_bytes as read_bytes
from .errors import EditError as EditError
from .errors import Error as Error
from .errors import LossWarning as LossWarning
from .errors import Problem as Problem
from .errors import RecipeError as RecipeError
