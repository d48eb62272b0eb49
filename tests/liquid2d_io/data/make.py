# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the particle files of this folder again: /usr/bin/python3 make.py (needs Debian's python3-vtk9).
import gzip
import os
import struct

import vtk
out=os.path.dirname(os.path.abspath(__file__))+'/'
N=24
def points():
    for i in range(N):
        x=0.1*(i%6); y=0.1*(i//6)
        yield i,(x,y,0.5),(1.0+0.25*i,-0.5*i,2.0),1000.0+i,100+7*i
def fill(grid):
    p=vtk.vtkPoints(); p.SetDataTypeToFloat()
    v=vtk.vtkFloatArray(); v.SetName('velocity'); v.SetNumberOfComponents(3)
    d=vtk.vtkDoubleArray(); d.SetName('density')
    n=vtk.vtkUnsignedIntArray(); n.SetName('id')
    e=vtk.vtkFloatArray(); e.SetName('pressure')
    c=vtk.vtkCellArray()
    for i,x,vel,rho,ident in points():
        p.InsertNextPoint(x); v.InsertNextTuple3(*vel); d.InsertNextValue(rho); n.InsertNextValue(ident); e.InsertNextValue(i)
        c.InsertNextCell(1); c.InsertCellPoint(i)
    grid.SetPoints(p)
    if isinstance(grid,vtk.vtkPolyData): grid.SetVerts(c)
    else: grid.SetCells(vtk.VTK_VERTEX,c)
    for a in (e,n,v,d): grid.GetPointData().AddArray(a)
    t=vtk.vtkDoubleArray(); t.SetName('TimeValue'); t.InsertNextValue(0.25); grid.GetFieldData().AddArray(t)
    return grid
def legacy(w,grid,name,binary,version,active=False):
    w.SetInputData(grid); w.SetFileName(out+name)
    (w.SetFileTypeToBinary if binary else w.SetFileTypeToASCII)()
    w.SetFileVersion(version)
    assert w.Write()
poly=fill(vtk.vtkPolyData()); ug=fill(vtk.vtkUnstructuredGrid())
legacy(vtk.vtkPolyDataWriter(),poly,'poly_ascii_51.vtk',False,51)
legacy(vtk.vtkPolyDataWriter(),poly,'poly_binary_42.vtk',True,42)
legacy(vtk.vtkUnstructuredGridWriter(),ug,'grid_binary_51.vtk',True,51)
act=fill(vtk.vtkUnstructuredGrid()); act.GetPointData().SetActiveVectors('velocity'); act.GetPointData().SetActiveScalars('id')
legacy(vtk.vtkUnstructuredGridWriter(),act,'grid_ascii_42.vtk',False,42)
def xml(w,grid,name,mode,compress,header=32,enc=True,big=False):
    w.SetInputData(grid); w.SetFileName(out+name)
    getattr(w,'SetDataModeTo'+mode)()
    w.SetCompressorTypeToZLib() if compress else w.SetCompressorTypeToNone()
    (w.SetHeaderTypeToUInt64 if header==64 else w.SetHeaderTypeToUInt32)()
    w.SetEncodeAppendedData(enc)
    if big: w.SetByteOrderToBigEndian()
    if compress: w.SetBlockSize(96)
    assert w.Write()
P=vtk.vtkXMLPolyDataWriter; U=vtk.vtkXMLUnstructuredGridWriter
xml(P(),poly,'ascii.vtp','Ascii',False)
xml(P(),poly,'binary.vtp','Binary',False)
xml(P(),poly,'binary_zlib.vtp','Binary',True,64)
xml(P(),poly,'appended_base64_zlib.vtp','Appended',True,32,True)
xml(P(),poly,'appended_raw_zlib.vtp','Appended',True,64,False)
xml(U(),ug,'appended_raw_big_endian.vtu','Appended',False,64,False,True)
print(vtk.vtkVersion.GetVTKVersion())
# classic BGEO, as written in Partio's layout; not by another program
def s(x): x=x.encode(); return struct.pack('>H',len(x))+x
b=b'Bgeo'+b'V'+struct.pack('>9i',5,N,0,0,0,4,0,0,0)
b+=s('id')+struct.pack('>Hi',1,1)+struct.pack('>i',0)
b+=s('material')+struct.pack('>Hii',1,4,2)+s('water')+s('milk')
b+=s('velocity')+struct.pack('>Hi',3,5)+struct.pack('>3f',0,0,0)
b+=s('density')+struct.pack('>Hi',1,0)+struct.pack('>f',0)
for i,x,vel,rho,ident in points():
    b+=struct.pack('>4f',*x,1.0)+struct.pack('>ii',ident,i%2)+struct.pack('>3f',*vel)+struct.pack('>f',rho)
b+=b'\x00\xff'
open(out+'partio_layout.bgeo','wb').write(b)
open(out+'partio_layout.bgeo.gz','wb').write(gzip.compress(b,mtime=0))
