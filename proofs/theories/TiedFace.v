(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Faces of exact points [TIE-2]: an edge between two triangles is legal iff their circles differ, an edge of the hull
   is legal, and a vertex of the hull is a strict corner iff it is not on the line of its neighbours. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Distance Cells Legal Orientation Disc PartialDisc QuadWitness.
Open Scope R_scope.

(* The rectangle of an exact point. *)
Definition exact (B : rect) (q : point) : Prop := inside q B /\ forall z, inside z B -> z = q.

Lemma exact_ds c B q : exact B q -> ds c B = dist c q.
Proof. intros [_ H]. unfold ds. now rewrite (H _ (nearest_inside c B)). Qed.

Lemma exact_dl c B q : exact B q -> dl c B = dist c q.
Proof. intros [_ H]. unfold dl. now rewrite (H _ (farthest_inside c B)). Qed.

(* The others are never inside of a circle, nor at p or q. *)
Definition outside (N : nat) (B : sites) (i j : nat) (p q o : point) (r : R) : Prop :=
  forall m, (m < N)%nat -> m <> i -> m <> j -> forall z, inside z (B m) -> r <= dist o z /\ z <> p /\ z <> q.

(* The difference of the powers of two points is affine in the centre. *)
Lemma power_mix t o w z p :
  dist2 (mix t o w) z - dist2 (mix t o w) p = (1 - t) * (dist2 o z - dist2 o p) + t * (dist2 w z - dist2 w p).
Proof. unfold dist2, mix. simpl. ring. Qed.

Lemma on_circle_sq o r z : dist o z = r -> dist2 o z = r * r.
Proof. intros <-. now rewrite dist_sq. Qed.

Lemma outside_sq o r z : 0 <= r -> r <= dist o z -> r * r <= dist2 o z.
Proof. intros P H. rewrite <- dist_sq. nra. Qed.

(* On a line a circle has two points: z = p + a v, q = p + b v. *)
Lemma circle_meets_line o p v a b q z : v <> (0, 0) ->
  q = (fst p + b * fst v, snd p + b * snd v) -> z = (fst p + a * fst v, snd p + a * snd v) ->
  dist2 o q = dist2 o p -> dist2 o z = dist2 o p -> p <> q -> z = p \/ z = q.
Proof.
  intros V Q Z Eq Ez D.
  assert (S : 0 < fst v * fst v + snd v * snd v).
  { destruct v as [x y]; simpl in *. pose proof (Rle_0_sqr x) as X. pose proof (Rle_0_sqr y) as Y. unfold Rsqr in X, Y.
    destruct (Req_dec (x * x + y * y) 0) as [E | E]; [| lra]. exfalso. apply V.
    destruct (Rplus_sqr_eq_0 x y) as [-> ->]; [unfold Rsqr; lra | reflexivity]. }
  assert (B0 : b <> 0).
  { intros ->. apply D. rewrite Q. destruct p; simpl. f_equal; ring. }
  set (s := fst v * fst v + snd v * snd v) in *.
  set (h := (fst o - fst p) * fst v + (snd o - snd p) * snd v).
  assert (Hb : b * (b * s - 2 * h) = 0).
  { transitivity (dist2 o q - dist2 o p); [rewrite Q; unfold dist2, s, h; simpl; ring | lra]. }
  assert (Ha : a * (a * s - 2 * h) = 0).
  { transitivity (dist2 o z - dist2 o p); [rewrite Z; unfold dist2, s, h; simpl; ring | lra]. }
  destruct (Rmult_integral _ _ Hb) as [E | Eb]; [contradiction |].
  destruct (Rmult_integral _ _ Ha) as [-> | Ea].
  - left. rewrite Z. destruct p; simpl. f_equal; ring.
  - right. assert (E : a = b) by (apply (Rmult_eq_reg_r s); lra). now rewrite Z, Q, E.
Qed.

(* Points with one scalar product with u differ by multiples of the vector across. *)
Lemma across u p z : u <> (0, 0) -> dot u p = dot u z ->
  exists a, z = (fst p + a * - snd u, snd p + a * fst u).
Proof.
  intros U E. assert (S : 0 < fst u * fst u + snd u * snd u).
  { destruct u as [x y]; simpl in *. pose proof (Rle_0_sqr x) as X. pose proof (Rle_0_sqr y) as Y. unfold Rsqr in X, Y.
    destruct (Req_dec (x * x + y * y) 0) as [F | F]; [| lra]. exfalso. apply U.
    destruct (Rplus_sqr_eq_0 x y) as [-> ->]; [unfold Rsqr; lra | reflexivity]. }
  set (s := fst u * fst u + snd u * snd u) in *.
  set (n := (snd z - snd p) * fst u - (fst z - fst p) * snd u). set (k := n / s).
  assert (K : k * s = n) by (unfold k; field; lra).
  exists k. rewrite (surjective_pairing z) at 1. f_equal; apply (Rmult_eq_reg_l s); try lra; apply Rminus_diag_uniq.
  - transitivity (s * (fst z - fst p) + (k * s) * snd u); [ring |]. rewrite K.
    transitivity (fst u * (dot u z - dot u p)); [unfold n, s, dot; ring | rewrite E; ring].
  - transitivity (s * (snd z - snd p) - (k * s) * fst u); [ring |]. rewrite K.
    transitivity (snd u * (dot u z - dot u p)); [unfold n, s, dot; ring | rewrite E; ring].
Qed.

Lemma across_nonzero u : u <> (0, 0) -> (- snd u, fst u) <> (0, 0).
Proof.
  intros U E. apply U. assert (X : fst u = 0) by exact (f_equal snd E).
  assert (Y : - snd u = 0) by exact (f_equal fst E). rewrite (surjective_pairing u). f_equal; lra.
Qed.

(* Different circles through p and q have no third point in common. *)
Lemma circles_meet_twice o w p q z : o <> w -> p <> q -> dist2 o q = dist2 o p -> dist2 w q = dist2 w p ->
  dist2 o z = dist2 o p -> dist2 w z = dist2 w p -> z = p \/ z = q.
Proof.
  intros D P Oq Wq Oz Wz. set (u := (fst w - fst o, snd w - snd o)).
  assert (U : u <> (0, 0)).
  { intros E. apply D. pose proof (f_equal fst E) as X. pose proof (f_equal snd E) as Y.
    unfold u in X, Y. simpl in X, Y.
    rewrite (surjective_pairing o), (surjective_pairing w). f_equal; lra. }
  assert (Q : dot u p = dot u q) by (unfold dist2 in *; unfold dot, u; simpl; lra).
  assert (Z : dot u p = dot u z) by (unfold dist2 in *; unfold dot, u; simpl; lra).
  destruct (across u p q U Q) as [b Hb]. destruct (across u p z U Z) as [a Ha].
  apply (circle_meets_line o p (- snd u, fst u) a b q z (across_nonzero u U)); assumption.
Qed.

(* A centre at which all others are strictly farther than two exact points. *)
Lemma exact_witness N B i j p q c : exact (B i) p -> exact (B j) q -> dist2 c q = dist2 c p ->
  (forall m, (m < N)%nat -> m <> i -> m <> j -> forall z, inside z (B m) -> dist2 c p < dist2 c z) -> legal N B i j.
Proof.
  intros P Q E H. exists c. intros m M Di Dj. rewrite (exact_dl c _ _ P), (exact_dl c _ _ Q).
  assert (L : dist2 c p < dist2 c (nearest c (B m))) by (apply (H m M Di Dj), nearest_inside).
  unfold ds. split; apply dist_lt; lra.
Qed.

Theorem tied_face_legal N B i j p q l o r o' r' : exact (B i) p -> exact (B j) q -> p <> q ->
  dist o p = r -> dist o q = r -> dist o' p = r' -> dist o' q = r' -> dist o' l = r' -> r < dist o l ->
  outside N B i j p q o r -> outside N B i j p q o' r' -> legal N B i j.
Proof.
  intros P Q D Op Oq Wp Wq Wl L O W.
  assert (Diff : o <> o') by (intros ->; lra).
  assert (R0 : 0 <= r) by (rewrite <- Op; apply dist_nonneg).
  assert (R1 : 0 <= r') by (rewrite <- Wp; apply dist_nonneg).
  pose proof (on_circle_sq _ _ _ Op). pose proof (on_circle_sq _ _ _ Oq).
  pose proof (on_circle_sq _ _ _ Wp). pose proof (on_circle_sq _ _ _ Wq).
  apply (exact_witness N B i j p q (mix (/ 2) o o') P Q).
  - pose proof (power_mix (/ 2) o o' q p). lra.
  - intros m M Di Dj z Z. destruct (O m M Di Dj z Z) as [Fo [Zp Zq]]. destruct (W m M Di Dj z Z) as [Fw _].
    pose proof (outside_sq o r z R0 Fo). pose proof (outside_sq o' r' z R1 Fw).
    pose proof (power_mix (/ 2) o o' z p).
    destruct (Req_dec (dist2 (mix (/ 2) o o') z) (dist2 (mix (/ 2) o o') p)) as [E | E]; [exfalso | lra].
    destruct (circles_meet_twice o o' p q z Diff D); try lra; contradiction.
Qed.

(* The same circle, and the two others on different sides: no disc holds the two alone. *)
Theorem tied_face_tie N B i j k l p q s t o r : (k < N)%nat -> (l < N)%nat ->
  k <> i -> k <> j -> l <> i -> l <> j ->
  exact (B i) p -> exact (B j) q -> exact (B k) s -> exact (B l) t ->
  0 < orient p q s -> orient p q t < 0 -> circle o r p q s -> dist o t = r -> ~ legal N B i j.
Proof.
  intros K L Ki Kj Li Lj P Q S T Ls Lt C E.
  apply (quad_without_witness N B i j k l K L Ki Kj Li Lj).
  - intros x y z X Y Z. now rewrite (proj2 P x X), (proj2 Q y Y), (proj2 S z Z).
  - intros x y z X Y Z. now rewrite (proj2 P x X), (proj2 Q y Y), (proj2 T z Z).
  - exists p, q, s, t, o, r. repeat split; try apply P; try apply Q; try apply S; try apply T; try apply C; exact E.
Qed.

(* An edge with a triangle on its left and no site on its right. *)
Theorem tied_face_hull_edge N B i j p q o r : exact (B i) p -> exact (B j) q -> p <> q ->
  dist o p = r -> dist o q = r -> outside N B i j p q o r ->
  (forall m, (m < N)%nat -> m <> i -> m <> j -> forall z, inside z (B m) -> 0 <= orient p q z) -> legal N B i j.
Proof.
  intros P Q D Op Oq O H. assert (R0 : 0 <= r) by (rewrite <- Op; apply dist_nonneg).
  pose proof (on_circle_sq _ _ _ Op) as Sp. pose proof (on_circle_sq _ _ _ Oq) as Sq.
  set (c := (fst o + (snd q - snd p), snd o - (fst q - fst p))).
  assert (C : forall z, dist2 c z - dist2 c p = dist2 o z - dist2 o p + 2 * orient p q z)
    by (intros z; unfold c, dist2, orient; simpl; ring).
  apply (exact_witness N B i j p q c P Q).
  - pose proof (C q) as E. replace (orient p q q) with 0 in E by (unfold orient; ring). lra.
  - intros m M Di Dj z Z. destruct (O m M Di Dj z Z) as [Fo [Zp Zq]].
    pose proof (outside_sq o r z R0 Fo). pose proof (H m M Di Dj z Z). pose proof (C z).
    destruct (Req_dec (dist2 c z) (dist2 c p)) as [E | E]; [exfalso | lra].
    set (u := (snd q - snd p, - (fst q - fst p))).
    assert (U : u <> (0, 0)).
    { intros F. apply D. pose proof (f_equal fst F) as G. pose proof (f_equal snd F) as I.
      unfold u in G, I. simpl in G, I.
      rewrite (surjective_pairing p), (surjective_pairing q). f_equal; lra. }
    assert (Eq : dot u p = dot u q) by (unfold dot, u; simpl; ring).
    assert (Ez : dot u p = dot u z).
    { assert (orient p q z = 0) as F by lra. unfold orient in F. unfold dot, u. simpl. lra. }
    destruct (across u p q U Eq) as [b Hb]. destruct (across u p z U Ez) as [a Ha].
    destruct (circle_meets_line o p (- snd u, fst u) a b q z (across_nonzero u U) Hb Ha);
      try assumption; try lra; contradiction.
Qed.

(* v with its neighbours a and b on the hull, all others on the left of a to v and of v to b. *)
Theorem tied_face_corner N B i a v b : 0 < orient a v b ->
  (forall m, (m < N)%nat -> m <> i -> forall z, inside z (B m) -> 0 <= orient a v z /\ 0 <= orient v b z /\ z <> v) ->
  exists u, forall m, (m < N)%nat -> m <> i -> forall z, inside z (B m) -> dot u z < dot u v.
Proof.
  intros T H. exists (snd v - snd a + (snd b - snd v), - (fst v - fst a) - (fst b - fst v)).
  intros m M D z Z. destruct (H m M D z Z) as [A [C F]].
  assert (E : dot (snd v - snd a + (snd b - snd v), - (fst v - fst a) - (fst b - fst v)) v -
    dot (snd v - snd a + (snd b - snd v), - (fst v - fst a) - (fst b - fst v)) z = orient a v z + orient v b z)
    by (unfold dot, orient; simpl; ring).
  destruct (Req_dec (orient a v z + orient v b z) 0) as [S | S]; [exfalso | lra].
  assert (A0 : orient a v z = 0) by lra. assert (C0 : orient v b z = 0) by lra. apply F.
  rewrite (surjective_pairing z), (surjective_pairing v).
  f_equal; apply Rminus_diag_uniq, (Rmult_eq_reg_l (orient a v b)); try lra; rewrite Rmult_0_r.
  - transitivity ((fst b - fst v) * orient a v z - (fst v - fst a) * orient v b z); [unfold orient; ring |].
    rewrite A0, C0. ring.
  - transitivity ((snd b - snd v) * orient a v z - (snd v - snd a) * orient v b z); [unfold orient; ring |].
    rewrite A0, C0. ring.
Qed.

Theorem tied_face_no_corner u a v b : between v a b -> ~ (dot u a < dot u v /\ dot u b < dot u v).
Proof.
  intros [t [T ->]] [A C].
  assert (E : dot u (mix t a b) = (1 - t) * dot u a + t * dot u b) by (unfold dot, mix; simpl; ring).
  set (m := dot u (mix t a b)) in *.
  assert (X : 0 <= (1 - t) * (m - dot u a)) by (apply Rmult_le_pos; lra).
  assert (Y : 0 <= t * (m - dot u b)) by (apply Rmult_le_pos; lra).
  destruct (Req_dec t 0) as [-> | N]; [lra |].
  assert (0 < t * (m - dot u b)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.
