(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The fifteenth part of the checker of certificates: polynomials in leaves that do not reduce to 0 and are 0 all the same.
   CheckerVanishSound.v says what follows. *)
From Coq Require Import ZArith NArith List Bool.
From Dyadel Require Import CheckerEnclosure CheckerAlgebra.
Import ListNotations.
Open Scope Z_scope.

(* A power, and another polynomial. *)
Definition cofactor : Type := N * poly.

Section Vanish.

Variable most u : Z.
Variable leaves : list (option relation).
Variable held : list interval.

(* Is p^m w = 0 an identity, and w seen not to be 0? *)
Definition vanishes (p : poly) (h : cofactor) : bool :=
  negb (sign_of (enclose_poly most u held (snd h)) =? 0) &&
  match N.iter (fst h) (product_of leaves p) (snd h) with [] => true | _ => false end.

End Vanish.
