//! What hangs together in a mesh.

use crate::error::SurfaceError;

/// The piece of each vertex: vertices of one triangle are of one piece. Pieces are numbered from 0 by
/// their first vertices.
pub fn vertex_pieces(triangles: &[[u32; 3]], vertices: usize) -> Result<Vec<i32>, SurfaceError> {
    if vertices > i32::MAX as usize {
        return Err(SurfaceError::Vertices { count: vertices });
    }
    let mut parent: Vec<u32> = (0..vertices as u32).collect();
    for triangle in triangles {
        if let Some(&index) = triangle.iter().find(|&&one| one as usize >= vertices) {
            return Err(SurfaceError::Corner {
                index,
                count: vertices,
            });
        }
        for pair in triangle.windows(2) {
            let (a, b) = (root(&mut parent, pair[0]), root(&mut parent, pair[1]));
            // The lesser number leads, so that a root comes before all that hangs on it.
            parent[a.max(b) as usize] = a.min(b);
        }
    }
    let mut pieces = vec![0; vertices];
    let mut count = 0;
    for vertex in 0..vertices {
        let leader = root(&mut parent, vertex as u32) as usize;
        if leader == vertex {
            pieces[vertex] = count;
            count += 1;
        } else {
            pieces[vertex] = pieces[leader];
        }
    }
    Ok(pieces)
}

/// The leader of a vertex's piece; the way to it becomes half as long.
fn root(parent: &mut [u32], vertex: u32) -> u32 {
    let mut at = vertex;
    while parent[at as usize] != at {
        parent[at as usize] = parent[parent[at as usize] as usize];
        at = parent[at as usize];
    }
    at
}
