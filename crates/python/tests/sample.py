"""A script with first steps. A test runs it unchanged, and it must pass the type checker."""

import meshwright as mw

m = mw.read("bunny.obj").mesh()
m.vertices, m.triangles
m.corners, m.face_starts
m = m.weld(distance=1e-6).loop_subdivide(levels=2)
m = m.measure(of="MeanCurvature", name="curvature")
m.attributes["curvature"]
r = mw.Recipe.load("clean.ron")
r.check()
out = r.run(input="scan.ply", levels=3)
r = mw.recipe().load("a.obj").simplify(faces=5000).save("a.glb")
print(r.to_ron())
m
m.view()
with m.edit() as e:
    edge = e.edge(*m.edges[0])
    e.flip(edge)
