(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* No exact zero during construction: no tie [TIE-1]. Exact points are inserted one by one by cavities; if no test of the
   insertions was 0, neighbouring triangles have different circles, so every edge is legal and every corner of the hull
   strict. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Distance Cells Legal Orientation Disc Path Fan TiedFace TiedRim.
Open Scope R_scope.

(* A mesh: triangles from all three corners, counterclockwise. N is the ghost: a b N is the ghost triangle beyond the hull
   edge from b to a. *)
Definition mesh : Type := nat -> nat -> nat -> Prop.

(* What predicates.c finds the sign of: positive inside of the circle of a real triangle, or beyond the hull edge. *)
Definition test (N : nat) (p : nat -> point) (a b c z : nat) : R :=
  if Nat.eqb a N then orient (p b) (p c) (p z) else if Nat.eqb b N then orient (p c) (p a) (p z)
  else if Nat.eqb c N then orient (p a) (p b) (p z) else incircle (p a) (p b) (p c) (p z).

(* A Delaunay triangulation of the points of S, ties allowed. *)
Definition delaunay (N : nat) (p : nat -> point) (S : nat -> Prop) (T : mesh) : Prop :=
  (forall a b c, T a b c -> T b c a /\ a <> b /\ (S a \/ a = N) /\
    ((a < N)%nat -> (b < N)%nat -> (c < N)%nat -> 0 < orient (p a) (p b) (p c)) /\
    (forall z, S z -> test N p a b c z <= 0)) /\
  (forall a b c d, T a b c -> T a b d -> c = d) /\
  (forall a b c, T a b c -> exists d, T b a d) /\
  (exists a b c, T a b c /\ (a < N)%nat /\ (b < N)%nat /\ (c < N)%nat) /\
  (forall z, S z -> (z < N)%nat).

(* No two triangles with an edge in common have one circle, nor two hull edges one line. *)
Definition untied (N : nat) (p : nat -> point) (T : mesh) : Prop :=
  forall a b c d, T a b c -> T b a d -> c <> N -> d <> N -> test N p a b c d < 0.

(* An edge of the rim of the cavity, from inside. *)
Definition rim_edge (T taken : mesh) (a b : nat) : Prop :=
  (exists c, taken a b c) /\ exists d, T b a d /\ ~ taken b a d.

(* v is inserted. The cavity grows from the triangle that holds v, or from a ghost triangle that v is strictly beyond; the
   triangles beyond its edges are tested, no test is 0, and those with a positive one are taken, too; what remains is
   joined to v. *)
Definition inserted (N : nat) (p : nat -> point) (T taken tested : mesh) (v : nat) (T' : mesh) : Prop :=
  (forall a b c, taken a b c -> T a b c /\ (tested a b c \/ 0 < test N p a b c v \/
    ((a < N)%nat /\ (b < N)%nat /\ (c < N)%nat /\ 0 <= orient (p a) (p b) (p v) /\
      0 <= orient (p b) (p c) (p v) /\ 0 <= orient (p c) (p a) (p v)))) /\
  (forall a b c d, taken a b c -> T b a d -> taken b a d \/ tested b a d) /\
  (forall a b c, tested a b c -> test N p a b c v <> 0 /\ (taken a b c <-> 0 < test N p a b c v)) /\
  (forall a b c, T' a b c -> (T a b c /\ ~ taken a b c) \/ (a = v /\ rim_edge T taken b c) \/
    (b = v /\ rim_edge T taken c a) \/ (c = v /\ rim_edge T taken a b)).

(* ---- the test ---- *)

Lemma about_circle o a b c : about o a b = 0 -> about o a c = 0 -> circle o (dist o a) a b c.
Proof. unfold about. intros X Y. repeat split; apply dist_eq; lra. Qed.

Lemma circle_about o r a b c : circle o r a b c -> about o a b = 0 /\ about o a c = 0 /\ r = dist o a.
Proof.
  intros [A [D E]]. assert (dist o b = dist o a) as X by lra. assert (dist o c = dist o a) as Y by lra.
  apply dist_eq in X. apply dist_eq in Y. unfold about. repeat split; lra.
Qed.

Lemma centre_of a b c : 0 < orient a b c -> exists o, about o a b = 0 /\ about o a c = 0 /\
  forall z, incircle a b c z = - orient a b c * about o a z.
Proof.
  intros D. destruct (circumcentre a b c) as [o [r [_ C]]]; [lra |]. exists o.
  destruct (circle_about _ _ _ _ _ C) as [X [Y E]]. split; [exact X |]. split; [exact Y |]. intros z.
  rewrite (incircle_power _ _ _ _ _ z C). unfold power, about. rewrite E, dist_sq. reflexivity.
Qed.

Lemma test_turned N p a b c d : a <> b -> c <> N -> d <> N -> test N p a b c d = test N p b a d c.
Proof.
  intros D C E. unfold test. destruct (Nat.eqb_spec a N) as [-> | A]; destruct (Nat.eqb_spec b N) as [-> | B].
  - now elim D.
  - unfold orient. ring.
  - unfold orient. ring.
  - destruct (Nat.eqb_spec c N); [contradiction |]. destruct (Nat.eqb_spec d N); [contradiction |].
    unfold incircle, dist2, orient. ring.
Qed.

(* ---- the new edges ---- *)

(* d, v, b and v, b, c are joined to v over the rim; were the four on one circle, the triangle taken at b c, in whose
   circle v is, would have d in it, too. *)
Lemma spoke v b c d x : 0 < orient v b c -> 0 < orient b v d -> incircle v b c d = 0 -> 0 < orient b c x ->
  incircle b c x d <= 0 -> 0 < incircle b c x v -> False.
Proof.
  intros O1 O2 Z O3 Dd Dv. destruct (centre_of v b c O1) as [o [A1 [A2 F]]].
  rewrite F in Z. assert (Ad : about o v d = 0).
  { apply Ropp_eq_compat in Z. rewrite Ropp_0, Ropp_mult_distr_l, Ropp_involutive in Z.
    destruct (Rmult_integral _ _ Z); lra. }
  assert (O4 : orient v b d < 0) by (unfold orient in *; lra).
  destruct (cap o v b c d A1 A2 O1 O4) as [P _]; [lra |].
  destruct (centre_of b c x O3) as [w [B1 [B2 G]]]. rewrite G in Dd, Dv.
  assert (Nbc : b <> c) by (intros ->; unfold orient in O1; lra).
  destruct (pencil o w b c Nbc) as [l L]; [unfold about in *; lra | exact B1 |].
  assert (Wd : 0 <= about w b d) by nra. assert (Wv : about w b v < 0) by nra.
  rewrite L in Wd, Wv. replace (about o b d) with 0 in Wd by (unfold about in *; lra).
  replace (about o b v) with 0 in Wv by (unfold about in *; lra).
  assert (0 < orient b c v) by (unfold orient in *; lra). nra.
Qed.

Lemma spoke_at_hull v b c d : 0 < orient v b c -> 0 < orient b v d -> incircle v b c d = 0 -> orient b c d <= 0 -> False.
Proof.
  intros O1 O2 Z O3. destruct (centre_of v b c O1) as [o [A1 [A2 F]]].
  rewrite F in Z. assert (Ad : about o v d = 0).
  { apply Ropp_eq_compat in Z. rewrite Ropp_0, Ropp_mult_distr_l, Ropp_involutive in Z.
    destruct (Rmult_integral _ _ Z); lra. }
  assert (O4 : orient v b d < 0) by (unfold orient in *; lra).
  destruct (cap o v b c d A1 A2 O1 O4) as [P _]; lra.
Qed.

Lemma orient_mix x y t u w : orient x y (mix t u w) = (1 - t) * orient x y u + t * orient x y w.
Proof. unfold orient, mix. simpl. ring. Qed.

(* v is a corner of the hull between d and c. *)
Lemma hull_spoke v c d x e f : c <> d -> orient c v d = 0 -> 0 < orient c x v -> orient c x d <= 0 ->
  orient d e v < 0 -> orient d e c <= 0 -> orient f c v < 0 -> orient f c d <= 0 -> False.
Proof.
  intros D Z X1 X2 E1 E2 F1 F2. destruct (one_between c v d Z) as [[t [T E]] | [[t [T E]] | [t [T E]]]].
  - assert (K : orient f c c = (1 - t) * orient f c v + t * orient f c d) by (rewrite E at 2; apply orient_mix).
    replace (orient f c c) with 0 in K by (unfold orient; ring).
    destruct (Req_dec t 1) as [-> | T1]; [apply D; rewrite E; apply mix_1 | nra].
  - assert (K : orient c x v = (1 - t) * orient c x c + t * orient c x d) by (rewrite E at 1; apply orient_mix).
    replace (orient c x c) with 0 in K by (unfold orient; ring). nra.
  - assert (K : orient d e d = (1 - t) * orient d e c + t * orient d e v) by (rewrite E at 2; apply orient_mix).
    replace (orient d e d) with 0 in K by (unfold orient; ring).
    destruct (Req_dec t 0) as [-> | T0]; [apply D; rewrite E; symmetry; apply mix_0 | nra].
Qed.

Section Insertion.
Variables (N : nat) (p : nat -> point) (S : nat -> Prop) (T taken tested T' : mesh) (v : nat).
Variable before : delaunay N p S T.
Variable after : delaunay N p (fun z => S z \/ z = v) T'.
Variable new : ~ S v /\ forall z, S z -> p z <> p v.
Variable distinct : forall a b, S a -> S b -> a <> b -> p a <> p b.
Variable step : inserted N p T taken tested v T'.

Lemma v_real : (v < N)%nat.
Proof. destruct after as [_ [_ [_ [_ H]]]]. apply H. now right. Qed.

Lemma old_corner a b c : T a b c -> (S a \/ a = N) /\ (S b \/ b = N) /\ (S c \/ c = N) /\ a <> b /\ b <> c /\ c <> a.
Proof.
  intros F. destruct before as [R _]. destruct (R _ _ _ F) as [G [D [A _]]]. destruct (R _ _ _ G) as [H [E [B _]]].
  destruct (R _ _ _ H) as [_ [I [C _]]]. tauto.
Qed.

Lemma not_v a : S a \/ a = N -> a <> v.
Proof. pose proof v_real. destruct new. intros [A | A] ->; [contradiction | lia]. Qed.

Lemma site a : S a \/ a = N -> a <> N -> S a /\ (a < N)%nat.
Proof. intros [A | A] D; [| contradiction]. split; [exact A |]. destruct before as [_ [_ [_ [_ H]]]]. now apply H. Qed.

(* A triangle that is taken has v strictly inside, or beyond. *)
Lemma taken_inside a b c : taken a b c -> T a b c /\ 0 < test N p a b c v.
Proof.
  intros F. destruct step as [H [_ [K _]]]. destruct (H _ _ _ F) as [G [X | [X | [A [B [C [X [Y Z]]]]]]]].
  - split; [exact G |]. destruct (K _ _ _ X) as [_ E]. now apply E.
  - now split.
  - split; [exact G |]. unfold test. destruct (Nat.eqb_spec a N); [lia |]. destruct (Nat.eqb_spec b N); [lia |].
    destruct (Nat.eqb_spec c N); [lia |].
    destruct before as [R _]. destruct (R _ _ _ G) as [_ [_ [_ [O _]]]]. specialize (O A B C).
    destruct (old_corner _ _ _ G) as [Sa [Sb [Sc _]]].
    destruct (site a Sa) as [Sa' _]; [lia |]. destruct (site b Sb) as [Sb' _]; [lia |]. destruct (site c Sc) as [Sc' _]; [lia |].
    destruct (centre_of _ _ _ O) as [o [A1 [A2 E]]]. rewrite E.
    assert (about o (p a) (p v) < 0); [| nra].
    destruct new as [_ Nv].
    apply (in_triangle o (p a) (p b) (p c) (p v)); auto; apply not_eq_sym; auto.
Qed.

(* A triangle beyond the rim was tested, and is strictly not to be taken. *)
Lemma rim_tested a b d : rim_edge T taken a b -> T b a d -> ~ taken b a d /\ test N p b a d v < 0.
Proof.
  intros [[c C] [d' [D' Nd]]] D. destruct before as [_ [U _]]. rewrite (U _ _ _ _ D' D) in *. split; [exact Nd |].
  destruct step as [_ [H [K _]]]. destruct (H _ _ _ _ C D) as [X | X]; [contradiction |].
  destruct (K _ _ _ X) as [Z E]. apply Rnot_le_lt. intros L. apply Nd, E. lra.
Qed.

Lemma over_rim a b d : rim_edge T taken a b -> T' b a d -> a <> v -> b <> v -> d <> v -> T b a d.
Proof. intros _ F A B D. destruct step as [_ [_ [_ H]]]. destruct (H _ _ _ F) as [[G _] | [[E _] | [[E _] | [E _]]]]; tauto. Qed.

Lemma rim_one_way a b : rim_edge T taken a b -> ~ rim_edge T taken b a.
Proof.
  intros [[c C] _] [_ [d [D Nd]]]. destruct before as [_ [U _]]. destruct (taken_inside _ _ _ C) as [G _].
  now rewrite (U _ _ _ _ D G) in Nd.
Qed.

Lemma new_against_old a b d : rim_edge T taken a b -> T' b a d -> a <> v -> b <> v -> d <> N -> a <> b ->
  test N p a b v d < 0.
Proof.
  intros Rm F A B Dn Ab. pose proof v_real. assert (D : d <> v).
  { intros ->. destruct step as [_ [_ [_ H0]]]. destruct (H0 _ _ _ F) as [[G _] | [[E _] | [[E _] | [_ E]]]]; try contradiction.
    - destruct (old_corner _ _ _ G) as [_ [_ [V _]]]. now apply (not_v v V).
    - now apply (rim_one_way a b). }
  destruct (rim_tested a b d Rm (over_rim a b d Rm F A B D)) as [_ L].
  rewrite test_turned; auto. lia.
Qed.

Lemma rim_ends a b : rim_edge T taken a b -> (S a \/ a = N) /\ (S b \/ b = N) /\ a <> b.
Proof. intros [[c C] _]. destruct (taken_inside _ _ _ C) as [G _]. pose proof (old_corner _ _ _ G). tauto. Qed.

Lemma new_against_new b c d : rim_edge T taken b c -> rim_edge T taken d b -> T' v b c -> T' b v d -> c <> N -> d <> N ->
  test N p v b c d < 0.
Proof.
  intros R1 R2 F1 F2 Cn Dn. pose proof v_real as V.
  destruct (rim_ends _ _ R1) as [Sb [Sc Dbc]]. destruct (rim_ends _ _ R2) as [Sd [_ Ddb]].
  destruct (site c Sc Cn) as [Sc' Lc]. destruct (site d Sd Dn) as [Sd' Ld].
  destruct after as [R' _]. destruct (R' _ _ _ F1) as [_ [_ [_ [O1 W1]]]]. destruct (R' _ _ _ F2) as [_ [_ [_ [O2 _]]]].
  pose proof (W1 d (or_introl Sd')) as Weak.
  destruct (Req_dec (test N p v b c d) 0) as [Z | Z]; [exfalso | lra].
  assert (K1 := R1). destruct K1 as [[x X] [f [Ff Nf]]]. destruct (taken_inside _ _ _ X) as [Tx Px].
  destruct before as [R [U [_ [_ Re]]]]. destruct (R _ _ _ Tx) as [_ [_ [_ [Ox Wx]]]]. pose proof (Wx d Sd') as Wd.
  destruct (Nat.eq_dec b N) as [Eb | Eb].
  - subst b. unfold test in Z, Px, Wd. destruct (Nat.eqb_spec v N); [lia |]. rewrite Nat.eqb_refl in Z, Px, Wd.
    destruct (rim_tested N c f R1 Ff) as [_ Pf]. assert (K2 := R2). destruct K2 as [[y Y] [e [Fe Ne]]].
    destruct (rim_tested d N e R2 Fe) as [_ Pe]. destruct (R _ _ _ Ff) as [_ [_ [_ [_ Wf]]]]. destruct (R _ _ _ Fe) as [_ [_ [_ [_ We]]]].
    specialize (Wf d Sd'). specialize (We c Sc'). unfold test in Pf, Pe, Wf, We. rewrite Nat.eqb_refl in Pf, Pe, Wf, We.
    destruct (Nat.eqb_spec c N); [contradiction |].
    assert (Dcd : c <> d).
    { intros ->. destruct (taken_inside _ _ _ Y) as [Ty _]. now rewrite (U _ _ _ _ Ff Ty) in Nf. }
    apply (hull_spoke (p v) (p c) (p d) (p x) (p e) (p f)); auto.
  - destruct (site b Sb Eb) as [Sb' Lb]. specialize (O1 V Lb Lc). specialize (O2 Lb V Ld).
    unfold test in Z, Px, Wd. destruct (Nat.eqb_spec v N); [lia |]. destruct (Nat.eqb_spec b N); [contradiction |].
    destruct (Nat.eqb_spec c N); [contradiction |]. destruct (Nat.eqb_spec x N) as [Ex | Ex].
    + apply (spoke_at_hull (p v) (p b) (p c) (p d)); auto.
    + destruct (old_corner _ _ _ Tx) as [_ [_ [Sx _]]]. destruct (site x Sx Ex) as [_ Lx].
      apply (spoke (p v) (p b) (p c) (p d) (p x)); auto.
Qed.

Theorem insertion_untied : untied N p T -> untied N p T'.
Proof.
  intros Un a b c d F G Cn Dn. pose proof v_real as V. destruct after as [R' _].
  destruct (R' _ _ _ F) as [Fr [Dab _]]. destruct (R' _ _ _ Fr) as [_ [Dbc _]].
  destruct (R' _ _ _ G) as [Gr [_ _]]. destruct (R' _ _ _ Gr) as [_ [Dad _]].
  assert (C := step). destruct C as [_ [_ [_ H]]].
  destruct (H _ _ _ F) as [[Fo Nf] | [[-> Rm] | [[-> Rm] | [-> Rm]]]].
  - destruct (old_corner _ _ _ Fo) as [Sa [Sb _]]. pose proof (not_v a Sa) as Av. pose proof (not_v b Sb) as Bv.
    destruct (H _ _ _ G) as [[Go Ng] | [[E _] | [[E _] | [-> Rm]]]]; try contradiction.
    + now apply Un.
    + rewrite test_turned by auto. apply new_against_old; auto.
  - destruct (rim_ends _ _ Rm) as [Sb [Sc _]]. pose proof (not_v b Sb) as Bv.
    destruct (H _ _ _ G) as [[Go Ng] | [[E _] | [[_ Rn] | [E _]]]]; try contradiction; try (now elim Dad).
    + destruct (old_corner _ _ _ Go) as [_ [Sv _]]. exfalso. now apply (not_v v Sv).
    + apply new_against_new; auto.
  - destruct (rim_ends _ _ Rm) as [Sc [Sa _]]. pose proof (not_v a Sa) as Av.
    destruct (H _ _ _ G) as [[Go Ng] | [[_ Rn] | [[E _] | [E Rn]]]]; try contradiction.
    + destruct (old_corner _ _ _ Go) as [Sv _]. exfalso. now apply (not_v v Sv).
    + rewrite test_turned by auto. apply new_against_new; auto.
    + destruct (rim_ends _ _ Rn) as [Sv _]. exfalso. now apply (not_v v Sv).
  - destruct (rim_ends _ _ Rm) as [Sa [Sb _]]. pose proof (not_v a Sa) as Av. pose proof (not_v b Sb) as Bv.
    apply new_against_old; auto.
Qed.
End Insertion.

(* ---- what a mesh without ties says ---- *)

Section Certain.
Variables (N : nat) (p : nat -> point) (T : mesh) (B : sites).
Variable distinct : forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> p a <> p b.
Variable all : delaunay N p (fun z => (z < N)%nat) T.
Variable tight : untied N p T.
Variable points : forall k, (k < N)%nat -> exact (B k) (p k).

Lemma mesh_site a b c : T a b c -> (a < N)%nat \/ a = N.
Proof. intros F. destruct all as [R _]. now destruct (R _ _ _ F) as [_ [_ [A _]]]. Qed.

Lemma mesh_circle i j k : T i j k -> (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> p i <> p j /\
  0 < orient (p i) (p j) (p k) /\ exists o, dist o (p j) = dist o (p i) /\ dist o (p k) = dist o (p i) /\
    outside N B i j (p i) (p j) o (dist o (p i)) /\
    forall z, test N p i j k z = - orient (p i) (p j) (p k) * about o (p i) (p z).
Proof.
  intros F I J K. destruct all as [R _]. destruct (R _ _ _ F) as [_ [D [_ [O W]]]].
  specialize (O I J K). split; [now apply distinct |]. split; [exact O |].
  destruct (centre_of _ _ _ O) as [o [X [Y Z]]]. exists o.
  assert (Z' : forall z, test N p i j k z = - orient (p i) (p j) (p k) * about o (p i) (p z)).
  { intros z. unfold test. destruct (Nat.eqb_spec i N); [lia |]. destruct (Nat.eqb_spec j N); [lia |].
    destruct (Nat.eqb_spec k N); [lia |]. apply Z. }
  split; [apply dist_eq; unfold about in X; lra |]. split; [apply dist_eq; unfold about in Y; lra |]. split; [| exact Z'].
  intros m M Di Dj z In. rewrite (proj2 (points m M) z In). split; [| split; now apply distinct].
  apply dist_le. specialize (W m M). rewrite Z' in W. unfold about in W. nra.
Qed.

Lemma hull_side a b : T a b N -> forall z, (z < N)%nat -> orient (p a) (p b) (p z) <= 0.
Proof.
  intros F z Z. destruct all as [R _]. destruct (R _ _ _ F) as [G [D [A [_ W]]]].
  destruct (R _ _ _ G) as [G' [E _]]. destruct (R _ _ _ G') as [_ [E' _]].
  specialize (W z Z). unfold test in W. destruct (Nat.eqb_spec a N); [congruence |].
  destruct (Nat.eqb_spec b N); [congruence |]. now rewrite Nat.eqb_refl in W.
Qed.

(* Every edge of the skeleton. *)
Theorem untied_legal a b c : T a b c -> (a < N)%nat -> (b < N)%nat -> legal N B a b.
Proof.
  intros F A C. destruct all as [R [_ [Tw [[x [y [z [Q [X [Y Z]]]]]] _]]]].
  assert (Main : forall i j k l, T i j k -> T j i l -> (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> legal N B i j).
  { intros i j k l G H I J K. destruct (mesh_circle i j k G I J K) as [D [O [o [Oj [Ok [Out Te]]]]]].
    destruct (R _ _ _ H) as [H1 _]. destruct (R _ _ _ H1) as [H2 _]. destruct (mesh_site _ _ _ H2) as [L | ->].
    - destruct (mesh_circle j i l H J I L) as [_ [_ [w [Wi [Wl [OutW _]]]]]].
      apply (tied_face_legal N B i j (p i) (p j) (p l) o (dist o (p i)) w (dist w (p j)));
        auto; try (now symmetry); try (now rewrite Wi).
      + apply dist_lt. assert (U : test N p i j k l < 0) by (apply (tight i j k l); auto; lia).
        rewrite Te in U. unfold about in U. nra.
      + intros m M Di Dj q In. destruct (OutW m M Dj Di q In). tauto.
    - apply (tied_face_hull_edge N B i j (p i) (p j) o (dist o (p i))); auto. intros m M _ _ q In.
      rewrite (proj2 (points m M) q In). pose proof (hull_side j i H m M). rewrite orient_cycle, orient_swap. lra. }
  destruct (Tw _ _ _ F) as [d G]. destruct (R _ _ _ F) as [F1 [Dab _]]. destruct (R _ _ _ F1) as [F2 _].
  destruct (R _ _ _ G) as [G1 _]. destruct (R _ _ _ G1) as [G2 _].
  destruct (mesh_site _ _ _ F2) as [K | ->]; [now apply (Main a b c d) |].
  destruct (mesh_site _ _ _ G2) as [K | ->].
  - destruct (Main b a d N G F C A K) as [o W]. exists o. now apply witness_sym.
  - exfalso. destruct (R _ _ _ Q) as [_ [_ [_ [O _]]]]. specialize (O X Y Z).
    assert (Flat : forall m, (m < N)%nat -> orient (p a) (p b) (p m) = 0).
    { intros m M. pose proof (hull_side a b F m M). pose proof (hull_side b a G m M). unfold orient in *. lra. }
    pose proof (Flat x X) as Fx. pose proof (Flat y Y) as Fy. pose proof (Flat z Z) as Fz.
    assert (S : 0 < dist2 (p a) (p b)).
    { pose proof (dist_pos _ _ (distinct a b A C Dab)). rewrite <- dist_sq. nra. }
    set (k u := (fst u - fst (p a)) * (fst (p b) - fst (p a)) + (snd u - snd (p a)) * (snd (p b) - snd (p a))).
    assert (E : dist2 (p a) (p b) * orient (p x) (p y) (p z) =
      orient (p a) (p b) (p x) * (k (p z) - k (p y)) + orient (p a) (p b) (p y) * (k (p x) - k (p z)) +
      orient (p a) (p b) (p z) * (k (p y) - k (p x))) by (unfold k, dist2, orient; ring).
    rewrite Fx, Fy, Fz in E. nra.
Qed.

(* Every vertex of the hull, between c and d. *)
Theorem untied_corner v c d : T v N c -> T N v d -> sure_hull N B v /\ orient (p c) (p v) (p d) <> 0.
Proof.
  intros F G. destruct all as [R _].
  destruct (R _ _ _ F) as [F1 [Dv [V _]]]. destruct V as [V | V]; [| contradiction].
  destruct (R _ _ _ F1) as [F2 [Dc _]]. destruct (R _ _ _ F2) as [_ [Dcv _]].
  destruct (R _ _ _ G) as [G1 _]. destruct (R _ _ _ G1) as [G2 [_ _]]. destruct (R _ _ _ G2) as [_ [Dd _]].
  assert (U : test N p v N c d < 0) by (apply (tight v N c d); auto).
  assert (O : orient (p c) (p v) (p d) < 0).
  { unfold test in U. destruct (Nat.eqb_spec v N); [contradiction |]. now rewrite Nat.eqb_refl in U. }
  split; [| lra]. destruct (tied_face_corner N B v (p d) (p v) (p c)) as [u H].
  - unfold orient in *. lra.
  - intros m M Dm z In. rewrite (proj2 (points m M) z In).
    pose proof (hull_side c v F2 m M) as X. pose proof (hull_side v d G1 m M) as Y.
    split; [unfold orient in *; lra |]. split; [unfold orient in *; lra |]. now apply distinct.
  - exists u. intros k x y K Dk Ix Iy. rewrite (proj2 (points v V) x Ix). now apply (H k K Dk).
Qed.
End Certain.

(* ---- all insertions ---- *)

(* The first triangle, its ghosts round it; then insertions. Each mesh is a Delaunay triangulation of its sites. *)
Inductive built (N : nat) (p : nat -> point) : (nat -> Prop) -> mesh -> Prop :=
| built_first a b c (T : mesh) : (a < N)%nat -> (b < N)%nat -> (c < N)%nat -> 0 < orient (p a) (p b) (p c) ->
    (forall x y z, T x y z -> In (x, y, z) ((a, b, c) :: (b, c, a) :: (c, a, b) ::
      (b, a, N) :: (a, N, b) :: (N, b, a) :: (c, b, N) :: (b, N, c) :: (N, c, b) ::
      (a, c, N) :: (c, N, a) :: (N, a, c) :: nil)) ->
    delaunay N p (fun z => z = a \/ z = b \/ z = c) T -> built N p (fun z => z = a \/ z = b \/ z = c) T
| built_more S T taken tested v T' : built N p S T -> ~ S v -> inserted N p T taken tested v T' ->
    delaunay N p (fun z => S z \/ z = v) T' -> built N p (fun z => S z \/ z = v) T'.

Lemma built_delaunay N p S T : built N p S T -> delaunay N p S T.
Proof. now intros []. Qed.

Lemma first_untied N p a b c (T : mesh) : (a < N)%nat -> (b < N)%nat -> (c < N)%nat ->
  0 < orient (p a) (p b) (p c) ->
  (forall x y z, T x y z -> In (x, y, z) ((a, b, c) :: (b, c, a) :: (c, a, b) ::
      (b, a, N) :: (a, N, b) :: (N, b, a) :: (c, b, N) :: (b, N, c) :: (N, c, b) ::
      (a, c, N) :: (c, N, a) :: (N, a, c) :: nil)) -> untied N p T.
Proof.
  intros A B C O H x y z w F G Zn Wn.
  assert (Dab : a <> b) by (intros ->; unfold orient in O; lra).
  assert (Dbc : b <> c) by (intros ->; unfold orient in O; lra).
  assert (Dca : c <> a) by (intros ->; unfold orient in O; lra).
  apply H in F. apply H in G. clear H. simpl in F, G.
  repeat match type of F with _ \/ _ => destruct F as [F | F] end; try contradiction; injection F; intros; subst x y z;
  repeat match type of G with _ \/ _ => destruct G as [G | G] end; try contradiction; injection G; intros;
  try (exfalso; lia); subst w; unfold test;
  repeat match goal with |- context [Nat.eqb ?u ?w] => destruct (Nat.eqb_spec u w); try (exfalso; lia) end;
  unfold orient in *; lra.
Qed.

Section Built.
Variables (N : nat) (p : nat -> point).
Variable distinct : forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> p a <> p b.

Theorem no_zero_untied S T : built N p S T -> untied N p T.
Proof.
  intros D. induction D as [a b c T A B C O H D | S T taken tested v T' D IH Nv St Af].
  - now apply (first_untied N p a b c).
  - pose proof (built_delaunay _ _ _ _ D) as Be. assert (Below : forall z, S z -> (z < N)%nat) by apply Be.
    assert (V : (v < N)%nat) by (apply Af; now right).
    apply (insertion_untied N p S T taken tested T' v); auto. split; [exact Nv |]. intros z Z. apply distinct; auto.
    now intros ->.
Qed.

Section All.
Variables (T : mesh) (B : sites).
Variable all : built N p (fun z => (z < N)%nat) T.
Variable points : forall k, (k < N)%nat -> exact (B k) (p k).

Theorem no_zero_legal a b c : T a b c -> (a < N)%nat -> (b < N)%nat -> legal N B a b.
Proof. apply (untied_legal N p T B distinct (built_delaunay _ _ _ _ all) (no_zero_untied _ _ all) points). Qed.

Theorem no_zero_corner v c d : T v N c -> T N v d -> sure_hull N B v /\ orient (p c) (p v) (p d) <> 0.
Proof. apply (untied_corner N p T B distinct (built_delaunay _ _ _ _ all) (no_zero_untied _ _ all) points). Qed.
End All.
End Built.
