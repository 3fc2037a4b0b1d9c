(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Pairs on the sphere are decided by the images in the plane [SPH-1], [SPH-5]: the projection from q takes circles to
   circles, those through q to lines, with the same points on the side away from q.
   Sites are numbered 0 .. N; the last one, N, is q. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Crossing Fan Sphere.
Open Scope R_scope.

Section Lift.
Variables (e n q : space).
Variable frame : axes e n q.
Let st (v : space) : point := image e n q v.

Lemma q_on_sphere : on_sphere q.
Proof. exact (unit_q e n q frame). Qed.

(* The plane h.x = m that belongs to a circle or line of the plane of images. *)
Definition plane_normal (g : conic) : space := Space
  (- cb g * sx e - cc g * sx n + (cd g - ca g) * sx q) (- cb g * sy e - cc g * sy n + (cd g - ca g) * sy q)
  (- cb g * sz e - cc g * sz n + (cd g - ca g) * sz q).
Definition plane_height (g : conic) : R := ca g + cd g.

Lemma normal_inner g v :
  inner (plane_normal g) v = - cb g * inner v e - cc g * inner v n + (cd g - ca g) * inner v q.
Proof. unfold inner, plane_normal. simpl. ring. Qed.

(* And the circle or line that belongs to a plane. *)
Definition conic_of (h : space) (m : R) : conic :=
  Conic ((m - inner h q) / 2) (- inner h e) (- inner h n) ((m + inner h q) / 2).

Lemma below_q v : on_sphere v -> v <> q -> 0 < 1 - inner v q.
Proof. intros V D. pose proof (apart v q V q_on_sphere D). lra. Qed.

Lemma lift_value g v : on_sphere v -> v <> q ->
  (1 - inner v q) * value g (st v) =
  (ca g + cd g) + cb g * inner v e + cc g * inner v n + (ca g - cd g) * inner v q.
Proof.
  intros V D. pose proof (below_q v V D) as P. unfold on_sphere in V. rewrite (of_axes _ _ _ frame v v) in V.
  unfold value, st, image, dot. simpl. set (a := inner v e) in *. set (b := inner v n) in *. set (c := inner v q) in *.
  transitivity (ca g * ((a * a + b * b) / (1 - c)) + cb g * a + cc g * b + cd g * (1 - c)); [field; lra |].
  replace (a * a + b * b) with ((1 + c) * (1 - c)) by lra.
  replace ((1 + c) * (1 - c) / (1 - c)) with (1 + c) by (field; lra). ring.
Qed.

(* The lifting: at each image the circle or line has the sign that the plane has at the point. q is on the plane iff it
   is a line, else outside of the circle (a > 0) means on the side of q. *)
Theorem circle_lifts g v : on_sphere v -> v <> q ->
  (1 - inner v q) * value g (st v) = plane_height g - inner (plane_normal g) v.
Proof. intros V D. rewrite lift_value by assumption. rewrite normal_inner. unfold plane_height. ring. Qed.

Theorem circle_at_q g : 2 * ca g = plane_height g - inner (plane_normal g) q.
Proof.
  rewrite normal_inner, (inner_sym q e), (inner_sym q n), (across_eq _ _ _ frame), (across_nq _ _ _ frame),
    (unit_q _ _ _ frame). unfold plane_height. ring.
Qed.

Theorem plane_projects h m v : on_sphere v -> v <> q ->
  (1 - inner v q) * value (conic_of h m) (st v) = m - inner h v.
Proof. intros V D. rewrite lift_value by assumption. rewrite (of_axes _ _ _ frame h v). simpl. field. Qed.

Lemma plane_value_sign h m v : on_sphere v -> v <> q ->
  (0 <= value (conic_of h m) (st v) <-> inner h v <= m) /\ (0 < value (conic_of h m) (st v) <-> inner h v < m) /\
  (value (conic_of h m) (st v) = 0 <-> inner h v = m).
Proof.
  intros V D. pose proof (below_q v V D) as P. pose proof (plane_projects h m v V D) as E.
  repeat split; intros H; nra.
Qed.

Lemma circle_value_sign g v : on_sphere v -> v <> q ->
  (0 <= value g (st v) -> inner (plane_normal g) v <= plane_height g) /\
  (0 < value g (st v) -> inner (plane_normal g) v < plane_height g) /\
  (value g (st v) = 0 -> inner (plane_normal g) v = plane_height g).
Proof.
  intros V D. pose proof (below_q v V D) as P. pose proof (circle_lifts g v V D) as E.
  repeat split; intros H; nra.
Qed.

(* The projection is one to one. *)
Lemma image_injective v w : on_sphere v -> on_sphere w -> v <> q -> w <> q -> st v = st w -> v = w.
Proof.
  intros V W Dv Dw E. pose proof (below_q v V Dv) as Pv. pose proof (below_q w W Dw) as Pw.
  assert (S : forall z, on_sphere z -> z <> q -> (1 - inner z q) * (dot (st z) (st z) + 1) = 2).
  { intros z Z D. pose proof (lift_value (Conic 1 0 0 1) z Z D) as L. unfold value in L. simpl in L. lra. }
  pose proof (S v V Dv) as Sv. pose proof (S w W Dw) as Sw. rewrite E in Sv.
  assert (Q : inner v q = inner w q).
  { set (k := dot (st w) (st w) + 1) in *. apply (Rmult_eq_reg_r k); [lra |].
    unfold k, dot. pose proof (Rle_0_sqr (fst (st w))) as A. pose proof (Rle_0_sqr (snd (st w))) as B.
    unfold Rsqr in *. lra. }
  pose proof (f_equal fst E) as X. pose proof (f_equal snd E) as Y. unfold st, image in X, Y. simpl in X, Y.
  rewrite Q in X, Y, Pv.
  assert (I : / (1 - inner w q) <> 0) by (apply Rinv_neq_0_compat; lra).
  assert (Xe : inner v e = inner w e) by exact (Rmult_eq_reg_r _ _ _ X I).
  assert (Yn : inner v n = inner w n) by exact (Rmult_eq_reg_r _ _ _ Y I).
  apply minus_zero. rewrite minus_sq, (of_axes _ _ _ frame v v), (of_axes _ _ _ frame w w), (of_axes _ _ _ frame v w).
  rewrite Xe, Yn, Q. ring.
Qed.

(* What turns left in the plane has q on the other side than what turns left seen from outside of the sphere. *)
Theorem image_turns u v w : triple e n q = 1 -> on_sphere u -> on_sphere v -> on_sphere w -> u <> q -> v <> q -> w <> q ->
  (1 - inner u q) * (1 - inner v q) * (1 - inner w q) * orient (st u) (st v) (st w) =
  triple (minus v u) (minus w u) (minus q u).
Proof.
  intros R U V W Du Dv Dw. pose proof (below_q u U Du). pose proof (below_q v V Dv). pose proof (below_q w W Dw).
  transitivity (triple (minus v u) (minus w u) (minus q u) * triple e n q); [| rewrite R; ring].
  rewrite triple_product, !minus_inner.
  rewrite (inner_sym q e), (inner_sym q n), (across_eq _ _ _ frame), (across_nq _ _ _ frame), (unit_q _ _ _ frame).
  unfold orient, st, image. simpl. field. lra.
Qed.

Lemma normal_nonzero g z : (ca g <> 0 \/ cb g <> 0 \/ cc g <> 0) -> value g z = 0 -> plane_normal g <> Space 0 0 0.
Proof.
  intros G Z H.
  assert (I : forall v, inner (plane_normal g) v = 0) by (intros v; rewrite H; unfold inner; simpl; ring).
  pose proof (I e) as Ie. pose proof (I n) as In. pose proof (I q) as Iq. rewrite normal_inner in Ie, In, Iq.
  rewrite (inner_sym n e) in In. rewrite (inner_sym q e), (inner_sym q n) in Iq.
  rewrite (across_en _ _ _ frame) in *. rewrite (across_eq _ _ _ frame) in *. rewrite (across_nq _ _ _ frame) in *.
  rewrite (unit_e _ _ _ frame) in Ie. rewrite (unit_n _ _ _ frame) in In. rewrite (unit_q _ _ _ frame) in Iq.
  assert (B : cb g = 0) by lra. assert (C : cc g = 0) by lra. assert (D : cd g = ca g) by lra.
  unfold value, dot in Z. rewrite B, C, D in Z.
  assert (A : ca g = 0).
  { pose proof (Rle_0_sqr (fst z)) as U. pose proof (Rle_0_sqr (snd z)) as V. unfold Rsqr in U, V.
    assert (T : ca g * (fst z * fst z + snd z * snd z + 1) = 0) by lra.
    destruct (Rmult_integral _ _ T); lra. }
  destruct G as [G | [G | G]]; contradiction.
Qed.

(* The conic of a proper plane is a circle or a line. *)
Lemma conic_nonzero h m : proper h m -> ca (conic_of h m) <> 0 \/ cb (conic_of h m) <> 0 \/ cc (conic_of h m) <> 0.
Proof.
  intros P. apply NNPP. intros H. apply not_or_and in H as [A H]. apply not_or_and in H as [B C].
  apply NNPP in A, B, C. simpl in A, B, C. unfold proper in P. rewrite (of_axes _ _ _ frame h h) in P.
  replace (inner h e) with 0 in P by lra. replace (inner h n) with 0 in P by lra.
  replace (inner h q) with m in P by lra. lra.
Qed.

(* A circle that is nonnegative at the images, and its centre. *)
Definition centre (g : conic) : point := (- cb g / (2 * ca g), - cc g / (2 * ca g)).

Lemma value_dist g x z : ca g <> 0 -> value g z - value g x = ca g * (dist2 (centre g) z - dist2 (centre g) x).
Proof. intros A. unfold value, dist2, centre, dot. simpl. field. exact A. Qed.

(* A line's value is an inner product. *)
Lemma line_value g z : ca g = 0 -> dot (- cb g, - cc g) z = cd g - value g z.
Proof. intros A. unfold value, dot. simpl. rewrite A. ring. Qed.

Lemma supported_weak_edge N p i j g : (i < N)%nat -> (j < N)%nat -> p i <> p j -> supports N p i j g -> weak_edge N p i j.
Proof.
  intros I J D [A [G [Vi [Vj H]]]]. destruct (Req_dec (ca g) 0) as [Z | Z].
  - right. exists (- cb g, - cc g), (cd g).
    assert (F : forall k, dot (- cb g, - cc g) (p k) = cd g - value g (p k)) by (intros k; now apply line_value).
    split.
    + intros E. injection E as E1 E2. destruct G as [G | [G | G]]; [contradiction | apply G; lra | apply G; lra].
    + split.
      * intros k _ [-> | ->]; rewrite F; lra.
      * intros k K. rewrite F. pose proof (H k K). lra.
  - left. exists (centre g), (dist (centre g) (p i)).
    assert (E : dist (centre g) (p j) = dist (centre g) (p i)).
    { apply dist_eq. pose proof (value_dist g (p i) (p j) Z). nra. }
    split.
    + destruct (Rle_lt_or_eq_dec _ _ (dist_nonneg (centre g) (p i))) as [P | P]; [exact P | exfalso].
      apply D. rewrite <- (dist_zero (centre g) (p i)) by lra. apply dist_zero. lra.
    + split.
      * intros k _ [-> | ->]; [reflexivity | exact E].
      * intros k K. apply dist_le. pose proof (value_dist g (p i) (p k) Z). pose proof (H k K). nra.
Qed.

Section Sites.
Variables (N : nat) (y : nat -> space).
Variable different : places (S N) y.
Variable last : y N = q.
Let p (k : nat) : point := st (y k).

Lemma site_ok k : (k < N)%nat -> on_sphere (y k) /\ y k <> q.
Proof.
  intros K. destruct different as [O D]. split; [apply O; lia |]. rewrite <- last. apply D; lia.
Qed.

Lemma all_sites (P : nat -> Prop) : (forall k, (k < N)%nat -> P k) -> P N -> forall k, (k < S N)%nat -> P k.
Proof. intros H L k K. destruct (Nat.eq_dec k N) as [-> | D]; [exact L | apply H; lia]. Qed.

Lemma images_differ i j : (i < N)%nat -> (j < N)%nat -> i <> j -> p i <> p j.
Proof.
  intros I J D E. destruct (site_ok i I) as [Oi Qi]. destruct (site_ok j J) as [Oj Qj]. destruct different as [_ H].
  apply (H i j); [lia | lia | exact D |]. now apply image_injective.
Qed.

(* (a) Pairs of sites other than q are as their images, centres at infinity included. *)
Theorem sphere_pairs i j : (i < N)%nat -> (j < N)%nat -> i <> j ->
  (sphere_edge (S N) y i j <-> weak_edge N p i j).
Proof.
  intros I J D. destruct (site_ok i I) as [Oi Qi]. destruct (site_ok j J) as [Oj Qj]. split.
  - intros [h [m [P [Ei [Ej H]]]]]. apply (supported_weak_edge N p i j (conic_of h m) I J (images_differ i j I J D)).
    split; [simpl; pose proof (H N (Nat.lt_succ_diag_r N)) as L; rewrite last in L; lra |].
    split; [now apply conic_nonzero |].
    split; [now apply (plane_value_sign h m (y i) Oi Qi) |]. split; [now apply (plane_value_sign h m (y j) Oj Qj) |].
    intros k K. destruct (site_ok k K) as [Ok Qk]. apply (plane_value_sign h m (y k) Ok Qk), H. lia.
  - intros W. destruct (weak_edge_supported N p i j I J W) as [g [A [G [Vi [Vj H]]]]].
    pose proof (proj2 (proj2 (circle_value_sign g (y i) Oi Qi)) Vi) as Ei.
    pose proof (proj2 (proj2 (circle_value_sign g (y j) Oj Qj)) Vj) as Ej.
    exists (plane_normal g), (plane_height g). split.
    + apply plane_is_proper with (y i) (y j); try assumption.
      * destruct different as [_ X]. apply X; [lia | lia | exact D].
      * now apply normal_nonzero with (p i).
    + split; [exact Ei |]. split; [exact Ej |]. apply all_sites.
      * intros k K. destruct (site_ok k K) as [Ok Qk]. now apply (circle_value_sign g (y k) Ok Qk), H.
      * rewrite last. pose proof (circle_at_q g). lra.
Qed.

Theorem sphere_strict_pairs i j : (i < N)%nat -> (j < N)%nat -> i <> j ->
  (sphere_strict_edge (S N) y i j <-> strict_edge N p i j).
Proof.
  intros I J D. destruct (site_ok i I) as [Oi Qi]. destruct (site_ok j J) as [Oj Qj]. split.
  - intros [h [m [P [Ei [Ej H]]]]]. set (g := conic_of h m).
    assert (A : 0 < ca g).
    { assert (L : inner h (y N) < m) by (apply H; lia). rewrite last in L. unfold g. simpl. lra. }
    assert (Vi : value g (p i) = 0) by now apply (plane_value_sign h m (y i) Oi Qi).
    assert (Vj : value g (p j) = 0) by now apply (plane_value_sign h m (y j) Oj Qj).
    exists (centre g). split.
    + apply dist_eq. pose proof (value_dist g (p i) (p j)). nra.
    + intros k K Di Dj. destruct (site_ok k K) as [Ok Qk].
      assert (V : 0 < value g (p k)) by (apply (plane_value_sign h m (y k) Ok Qk), H; [lia | exact Di | exact Dj]).
      apply dist_lt. pose proof (value_dist g (p i) (p k)). nra.
  - intros [c [E H]]. set (r := dist c (p i)).
    set (g := Conic 1 (-2 * fst c) (-2 * snd c) (dot c c - r * r)).
    assert (V : forall k, value g (p k) = dist2 c (p k) - r * r) by (intros k; apply disc_value).
    assert (Vi : value g (p i) = 0) by (rewrite V; unfold r; rewrite dist_sq; ring).
    assert (Vj : value g (p j) = 0) by (rewrite V; unfold r; rewrite E, dist_sq; ring).
    pose proof (proj2 (proj2 (circle_value_sign g (y i) Oi Qi)) Vi) as Ei.
    pose proof (proj2 (proj2 (circle_value_sign g (y j) Oj Qj)) Vj) as Ej.
    exists (plane_normal g), (plane_height g). split.
    + apply plane_is_proper with (y i) (y j); try assumption.
      * destruct different as [_ X]. apply X; [lia | lia | exact D].
      * apply normal_nonzero with (p i); [left; simpl; lra | exact Vi].
    + split; [exact Ei |]. split; [exact Ej |].
      apply (all_sites (fun k => k <> i -> k <> j -> inner (plane_normal g) (y k) < plane_height g)).
      * intros k K Di Dj. destruct (site_ok k K) as [Ok Qk]. apply (circle_value_sign g (y k) Ok Qk).
        fold (p k). rewrite V. pose proof (H k K Di Dj) as L. pose proof (dist_nonneg c (p i)) as R0. fold r in L, R0.
        rewrite <- dist_sq. nra.
      * intros _ _. rewrite last. pose proof (circle_at_q g) as X. simpl in X. lra.
Qed.

(* Three sites are a strict triangle as their images are. *)
Theorem sphere_triangles i j l : (i < N)%nat -> (j < N)%nat -> (l < N)%nat -> i <> j ->
  (sphere_triangle (S N) y i j l <-> exists c, dist c (p i) = dist c (p j) /\ dist c (p i) = dist c (p l) /\
    forall k, (k < N)%nat -> k <> i -> k <> j -> k <> l -> dist c (p i) < dist c (p k)).
Proof.
  intros I J L D. destruct (site_ok i I) as [Oi Qi]. destruct (site_ok j J) as [Oj Qj]. destruct (site_ok l L) as [Ol Ql].
  split.
  - intros [h [m [P [Ei [Ej [El H]]]]]]. set (g := conic_of h m).
    assert (A : 0 < ca g).
    { assert (X : inner h (y N) < m) by (apply H; lia). rewrite last in X. unfold g. simpl. lra. }
    assert (Vi : value g (p i) = 0) by now apply (plane_value_sign h m (y i) Oi Qi).
    assert (Vj : value g (p j) = 0) by now apply (plane_value_sign h m (y j) Oj Qj).
    assert (Vl : value g (p l) = 0) by now apply (plane_value_sign h m (y l) Ol Ql).
    exists (centre g). split; [apply dist_eq; pose proof (value_dist g (p i) (p j)); nra |].
    split; [apply dist_eq; pose proof (value_dist g (p i) (p l)); nra |].
    intros k K Di Dj Dl. destruct (site_ok k K) as [Ok Qk].
    assert (V : 0 < value g (p k)) by (apply (plane_value_sign h m (y k) Ok Qk), H; [lia | exact Di | exact Dj | exact Dl]).
    apply dist_lt. pose proof (value_dist g (p i) (p k)). nra.
  - intros [c [Ej [El H]]]. set (r := dist c (p i)) in *.
    set (g := Conic 1 (-2 * fst c) (-2 * snd c) (dot c c - r * r)).
    assert (V : forall k, value g (p k) = dist2 c (p k) - r * r) by (intros k; apply disc_value).
    assert (On : forall k, (k < N)%nat -> r = dist c (p k) -> inner (plane_normal g) (y k) = plane_height g).
    { intros k K E. destruct (site_ok k K) as [Ok Qk]. apply (circle_value_sign g (y k) Ok Qk). fold (p k).
      rewrite V, E, dist_sq. ring. }
    exists (plane_normal g), (plane_height g). split.
    + apply plane_is_proper with (y i) (y j); try assumption; try (now apply On).
      * destruct different as [_ X]. apply X; [lia | lia | exact D].
      * apply normal_nonzero with (p i); [left; simpl; lra |]. rewrite V. unfold r. rewrite dist_sq. ring.
    + split; [now apply On |]. split; [now apply On |]. split; [now apply On |].
      apply (all_sites (fun k => k <> i -> k <> j -> k <> l -> inner (plane_normal g) (y k) < plane_height g)).
      * intros k K Di Dj Dl. destruct (site_ok k K) as [Ok Qk]. apply (circle_value_sign g (y k) Ok Qk).
        fold (p k). rewrite V. pose proof (H k K Di Dj Dl) as X. pose proof (dist_nonneg c (p i)) as R0. fold r in R0.
        rewrite <- dist_sq. nra.
      * intros _ _ _. rewrite last. pose proof (circle_at_q g) as X. simpl in X. lra.
Qed.

(* (b) q and i are a pair as the image of i is on the boundary of the hull of all images. *)
Lemma line_of_pair h i : (i < N)%nat -> proper h (inner h q) -> inner h (y i) = inner h q ->
  let g := conic_of h (inner h q) in
  ca g = 0 /\ (- cb g, - cc g) <> (0, 0) /\ dot (- cb g, - cc g) (p i) = cd g.
Proof.
  intros I P E g. assert (A : ca g = 0) by (unfold g; simpl; lra). split; [exact A |].
  destruct (site_ok i I) as [Oi Qi]. split.
  - intros Z. assert (Z1 : - cb g = 0) by exact (f_equal fst Z). assert (Z2 : - cc g = 0) by exact (f_equal snd Z).
    destruct (conic_nonzero h _ P) as [G | [G | G]]; fold g in G; apply G; lra.
  - rewrite line_value by exact A. assert (value g (p i) = 0) by now apply (plane_value_sign h _ (y i) Oi Qi). lra.
Qed.

(* The plane through q that belongs to a line across u through the image of i. *)
Lemma pair_of_line u i : (i < N)%nat -> u <> (0, 0) ->
  let g := Conic 0 (- fst u) (- snd u) (dot u (p i)) in
  proper (plane_normal g) (plane_height g) /\ inner (plane_normal g) (y i) = plane_height g /\
  inner (plane_normal g) q = plane_height g /\ forall k, value g (p k) = dot u (p i) - dot u (p k).
Proof.
  intros I U g. destruct (site_ok i I) as [Oi Qi].
  assert (V : forall k, value g (p k) = dot u (p i) - dot u (p k)) by (intros k; unfold g, value, dot; simpl; ring).
  assert (Ei : inner (plane_normal g) (y i) = plane_height g).
  { apply (circle_value_sign g (y i) Oi Qi). fold (p i). rewrite V. ring. }
  assert (Eq : inner (plane_normal g) q = plane_height g) by (pose proof (circle_at_q g) as X; simpl in X; lra).
  split; [| now repeat split]. apply plane_is_proper with (y i) q; try assumption; [apply q_on_sphere |].
  apply normal_nonzero with (p i); [| rewrite V; ring]. right. apply NNPP. intros H. apply U.
  apply not_or_and in H as [A B]. apply NNPP in A, B. simpl in A, B. rewrite (surjective_pairing u). f_equal; lra.
Qed.

Theorem sphere_hull i : (i < N)%nat ->
  (sphere_edge (S N) y i N <-> exists u, u <> (0, 0) /\ forall k, (k < N)%nat -> dot u (p k) <= dot u (p i)).
Proof.
  intros I. split.
  - intros [h [m [P [Ei [Eq H]]]]]. rewrite last in Eq. rewrite <- Eq in P, Ei, H.
    destruct (line_of_pair h i I P Ei) as [A [U F]]. set (g := conic_of h (inner h q)) in *.
    exists (- cb g, - cc g). split; [exact U |]. intros k K. rewrite F, line_value by exact A.
    destruct (site_ok k K) as [Ok Qk].
    assert (0 <= value g (p k)) by (apply (plane_value_sign h _ (y k) Ok Qk), H; lia). lra.
  - intros [u [U H]]. destruct (pair_of_line u i I U) as [P [Ei [Eq V]]].
    set (g := Conic 0 (- fst u) (- snd u) (dot u (p i))) in *. exists (plane_normal g), (plane_height g).
    split; [exact P |]. split; [exact Ei |]. split; [now rewrite last |]. apply all_sites.
    + intros k K. destruct (site_ok k K) as [Ok Qk]. apply (circle_value_sign g (y k) Ok Qk). fold (p k). rewrite V.
      pose proof (H k K). lra.
    + rewrite last. lra.
Qed.

Theorem sphere_corner i : (i < N)%nat ->
  (sphere_strict_edge (S N) y i N <->
   exists u, u <> (0, 0) /\ forall k, (k < N)%nat -> k <> i -> dot u (p k) < dot u (p i)).
Proof.
  intros I. split.
  - intros [h [m [P [Ei [Eq H]]]]]. rewrite last in Eq. rewrite <- Eq in P, Ei, H.
    destruct (line_of_pair h i I P Ei) as [A [U F]]. set (g := conic_of h (inner h q)) in *.
    exists (- cb g, - cc g). split; [exact U |]. intros k K D. rewrite F, line_value by exact A.
    destruct (site_ok k K) as [Ok Qk].
    assert (0 < value g (p k)) by (apply (plane_value_sign h _ (y k) Ok Qk), H; [lia | exact D | lia]). lra.
  - intros [u [U H]]. destruct (pair_of_line u i I U) as [P [Ei [Eq V]]].
    set (g := Conic 0 (- fst u) (- snd u) (dot u (p i))) in *. exists (plane_normal g), (plane_height g).
    split; [exact P |]. split; [exact Ei |]. split; [now rewrite last |].
    apply (all_sites (fun k => k <> i -> k <> N -> inner (plane_normal g) (y k) < plane_height g)).
    + intros k K D _. destruct (site_ok k K) as [Ok Qk]. apply (circle_value_sign g (y k) Ok Qk). fold (p k). rewrite V.
      pose proof (H k K D). lra.
    + intros _ Z. now elim Z.
Qed.

(* Beyond a side of the hull with no other image on its line there is a triangle with q. *)
Theorem sphere_hull_triangle i j : (i < N)%nat -> (j < N)%nat ->
  (sphere_triangle (S N) y i j N <-> exists u, u <> (0, 0) /\ dot u (p i) = dot u (p j) /\
    forall k, (k < N)%nat -> k <> i -> k <> j -> dot u (p k) < dot u (p i)).
Proof.
  intros I J. destruct (site_ok j J) as [Oj Qj]. split.
  - intros [h [m [P [Ei [Ej [Eq H]]]]]]. rewrite last in Eq. rewrite <- Eq in P, Ei, Ej, H.
    destruct (line_of_pair h i I P Ei) as [A [U F]]. destruct (line_of_pair h j J P Ej) as [_ [_ G]].
    set (g := conic_of h (inner h q)) in *. exists (- cb g, - cc g). split; [exact U |]. split; [now rewrite F, G |].
    intros k K Di Dj. rewrite F, line_value by exact A. destruct (site_ok k K) as [Ok Qk].
    assert (0 < value g (p k)) by (apply (plane_value_sign h _ (y k) Ok Qk), H; [lia | exact Di | exact Dj | lia]). lra.
  - intros [u [U [E H]]]. destruct (pair_of_line u i I U) as [P [Ei [Eq V]]].
    set (g := Conic 0 (- fst u) (- snd u) (dot u (p i))) in *. exists (plane_normal g), (plane_height g).
    split; [exact P |]. split; [exact Ei |]. split.
    { apply (circle_value_sign g (y j) Oj Qj). fold (p j). rewrite V. lra. }
    split; [now rewrite last |].
    apply (all_sites (fun k => k <> i -> k <> j -> k <> N -> inner (plane_normal g) (y k) < plane_height g)).
    + intros k K Di Dj _. destruct (site_ok k K) as [Ok Qk]. apply (circle_value_sign g (y k) Ok Qk). fold (p k). rewrite V.
      pose proof (H k K Di Dj). lra.
    + intros _ _ Z. now elim Z.
Qed.

(* (d) Images on one circle or line belong to points on one circle of the sphere; q is on it iff it is a line. *)
Theorem sphere_circle g i j : (i < N)%nat -> (j < N)%nat -> i <> j -> (ca g <> 0 \/ cb g <> 0 \/ cc g <> 0) ->
  value g (p i) = 0 -> value g (p j) = 0 ->
  proper (plane_normal g) (plane_height g) /\
  (forall k, (k < N)%nat -> value g (p k) = 0 -> inner (plane_normal g) (y k) = plane_height g) /\
  (ca g = 0 <-> inner (plane_normal g) q = plane_height g).
Proof.
  intros I J D G Vi Vj.
  assert (On : forall k, (k < N)%nat -> value g (p k) = 0 -> inner (plane_normal g) (y k) = plane_height g).
  { intros k K V. destruct (site_ok k K) as [Ok Qk]. now apply (circle_value_sign g (y k) Ok Qk). }
  destruct (site_ok i I) as [Oi Qi]. destruct (site_ok j J) as [Oj Qj]. split; [| split; [exact On |]].
  - apply plane_is_proper with (y i) (y j); auto; [apply different; lia | now apply normal_nonzero with (p i)].
  - pose proof (circle_at_q g). split; intros; lra.
Qed.

(* (c) Rectangles that hold the images, for this choice of the sites and of q. *)
Theorem sphere_legal B i j : (i < N)%nat -> (j < N)%nat -> i <> j -> choice N B p ->
  legal N B i j -> sphere_strict_edge (S N) y i j.
Proof. intros I J D P L. apply sphere_strict_pairs; try assumption. now apply (legal_sound N B i j). Qed.

Theorem sphere_illegal B i j : (i < N)%nat -> (j < N)%nat -> i <> j -> choice N B p ->
  ~ possible N B i j -> ~ sphere_edge (S N) y i j.
Proof.
  intros I J D P H E. apply H, possible_exact; [exact I | exact J |]. exists p. split; [exact P |].
  now apply sphere_pairs.
Qed.

Theorem sphere_sure_hull B i : (i < N)%nat -> choice N B p -> sure_hull N B i -> sphere_strict_edge (S N) y i N.
Proof.
  intros I P [u U]. apply sphere_corner; [exact I |].
  assert (H : forall k, (k < N)%nat -> k <> i -> dot u (p k) < dot u (p i)).
  { intros k K D. apply (U k); [exact K | exact D | now apply P | now apply P]. }
  destruct (classic (u = (0, 0))) as [Z | Z].
  - exists (1, 0). split; [intros E; injection E; lra |]. intros k K D. pose proof (H k K D) as X. rewrite Z in X.
    unfold dot in X. simpl in X. lra.
  - now exists u.
Qed.

Theorem sphere_no_hull B i : (i < N)%nat -> choice N B p ->
  ~ (exists u, possible_far N B (fun k => k = i) u) -> ~ sphere_edge (S N) y i N.
Proof.
  intros I P H E. apply (sphere_hull i I) in E as [u [U F]]. apply H. apply nerve_far; [now exists i |].
  exists p, u, (dot u (p i)). split; [exact P |]. split; [exact U |]. split; [now intros k _ -> | exact F].
Qed.

(* q is no site [SPH-5]: legal stays legal, and what else becomes possible are pairs of neighbours of q. *)
Theorem sphere_free_legal i j : sphere_strict_edge (S N) y i j -> sphere_strict_edge N y i j.
Proof.
  intros [h [m [P [Ei [Ej H]]]]]. exists h, m. split; [exact P |]. split; [exact Ei |]. split; [exact Ej |].
  intros k K. apply H. lia.
Qed.

Theorem sphere_free_triangle i j l : sphere_triangle (S N) y i j l -> sphere_triangle N y i j l.
Proof.
  intros [h [m [P [Ei [Ej [El H]]]]]]. exists h, m. split; [exact P |]. split; [exact Ei |]. split; [exact Ej |].
  split; [exact El |]. intros k K. apply H. lia.
Qed.

Theorem sphere_free_edge i j : sphere_edge (S N) y i j -> sphere_edge N y i j.
Proof.
  intros [h [m [P [Ei [Ej H]]]]]. exists h, m. split; [exact P |]. split; [exact Ei |]. split; [exact Ej |].
  intros k K. apply H. lia.
Qed.

(* A cap with q inside shrinks towards i until q is on its circle. *)
Lemma cap_shrinks h m i : (i < N)%nat -> proper h m -> inner h (y i) = m -> (forall k, (k < N)%nat -> inner h (y k) <= m) ->
  m < inner h q -> sphere_edge (S N) y i N.
Proof.
  intros I P Ei H Q. destruct (site_ok i I) as [Oi Qi]. pose proof (apart (y i) q Oi q_on_sphere Qi) as A.
  set (b := inner h q - m). set (a := 1 - inner (y i) q).
  set (h' := Space (a * sx h + b * sx (y i)) (a * sy h + b * sy (y i)) (a * sz h + b * sz (y i))).
  assert (F : forall v, inner h' v = a * inner h v + b * inner (y i) v) by (intros v; unfold inner, h'; simpl; ring).
  assert (Fi : inner h' (y i) = a * m + b) by (rewrite F, Ei; unfold on_sphere in Oi; rewrite Oi; ring).
  assert (Fq : inner h' q = a * m + b) by (rewrite F; unfold a, b; ring).
  assert (Le : forall k, (k < N)%nat -> inner h' (y k) <= a * m + b).
  { intros k K. rewrite F. pose proof (H k K) as X. destruct (site_ok k K) as [Ok Qk].
    assert (inner (y i) (y k) <= 1).
    { destruct (classic (y i = y k)) as [<- | D]; [unfold on_sphere in Oi; lra | left; now apply apart]. }
    unfold a, b. nra. }
  exists h', (a * m + b). split.
  - apply plane_is_proper with (y i) q; try assumption; [apply q_on_sphere |]. intros Z.
    (* then h is a multiple of y i, and its plane touches the sphere there *)
    assert (X : forall v, a * inner h v + b * inner (y i) v = 0) by (intros v; rewrite <- F, Z; unfold inner; simpl; ring).
    pose proof (X (y i)) as X1. pose proof (X h) as X2. rewrite (inner_sym (y i) h), Ei in X2.
    unfold on_sphere in Oi. rewrite Ei, Oi in X1. unfold proper in P.
    assert (A0 : 0 < a) by (unfold a; lra). assert (B : b = - (a * m)) by lra. rewrite B in X2. nra.
  - split; [exact Fi |]. split; [now rewrite last |]. apply all_sites; [exact Le | rewrite last; lra].
Qed.

Theorem sphere_free_possible i j : (i < N)%nat -> (j < N)%nat -> sphere_edge N y i j ->
  sphere_edge (S N) y i j \/ (sphere_edge (S N) y i N /\ sphere_edge (S N) y j N).
Proof.
  intros I J [h [m [P [Ei [Ej H]]]]]. destruct (Rle_lt_dec (inner h q) m) as [Q | Q].
  - left. exists h, m. split; [exact P |]. split; [exact Ei |]. split; [exact Ej |].
    apply all_sites; [exact H | now rewrite last].
  - right. split; now apply cap_shrinks with h m.
Qed.
End Sites.
End Lift.
